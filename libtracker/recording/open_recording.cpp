#include <optional>
#include <utility>

#include <fmt/format.h>

#include "depthmocap/error.h"
#include "libtracker/core/check_camera.h"
#include "libtracker/recording/image_list_reader.h"
#include "libtracker/recording/oni_reader.h"
#include "libtracker/recording/recording.h"
#include "libtracker/recording/recording_header.h"
#include "libtracker/recording/tum_folder.h"
#include "libtracker/recording/turned_recording.h"

namespace depthmocap {

namespace fs = std::filesystem;

namespace {

std::unique_ptr<RecordingReader> openAsItIs(const fs::path& path, const RecordingCorrection& correction) {
  if (!fs::exists(path)) throw Error("there is no such recording", path.string());
  if (!fs::is_directory(path)) {
    if (path.extension() == ".oni") return openOniRecording(path);
    throw Error("is a file; a recording is a folder, or an OpenNI file named .oni", path.string());
  }
  if (fs::exists(path / "recording.json")) return openRecordingFolder(path);
  if (const std::optional<fs::path> index = tumIndex(path)) return openTumFolder(path, *index, correction);
  throw Error("is no recording: it holds neither recording.json nor depth.txt nor associations.txt", path.string());
}

CameraModel correctedCamera(const CameraModel& own, const std::optional<RecordingInfo>& given) {
  if (!given) return own;
  const CameraModel& camera = given->camera;
  if (camera.width == own.width && camera.height == own.height) return camera;
  throw Error(fmt::format("describes pictures of {}x{}, the recording's are {}x{}", camera.width, camera.height,
                          own.width, own.height),
              "--camera");
}

}  // namespace

RecordingCorrection readCorrection(const CameraCorrection& correction) {
  const auto [file, unit_m, turn_deg] = correction;
  if (unit_m && !(*unit_m >= kFinestUnit_m && *unit_m <= kCoarsestUnit_m)) {
    throw Error(fmt::format("{} is outside {} .. {}", *unit_m, kFinestUnit_m, kCoarsestUnit_m), "depth_unit_m");
  }
  if (turn_deg % 90 != 0 || turn_deg < 0 || turn_deg > 270) {
    throw Error(fmt::format("{} is none of 0, 90, 180 and 270", turn_deg), "turn_deg");
  }
  RecordingCorrection read{std::nullopt, unit_m, turn_deg};
  if (!file.empty()) read.camera = readRecordingHeader(file);
  return read;
}

void RecordingCorrection::validate() const {
  if (camera) {
    checkCamera(camera->camera, "camera");
    checkRates(*camera, "camera");
  }
  RecordingInfo with_unit;
  with_unit.depth_unit_m = depth_unit_m.value_or(with_unit.depth_unit_m);
  checkRates(with_unit, "correction");
  if (turn_deg == 0 || turn_deg == 90 || turn_deg == 180 || turn_deg == 270) return;
  throw Error(fmt::format("turn_deg must be 0, 90, 180 or 270, not {}", turn_deg), "correction");
}

bool looksLikeRecording(const fs::path& path) {
  std::error_code unknown;
  if (!fs::is_directory(path, unknown)) return path.extension() == ".oni";
  return fs::exists(path / "recording.json", unknown) || fs::exists(path / "depth.txt", unknown);
}

std::unique_ptr<RecordingReader> openRecording(const fs::path& path, const RecordingCorrection& correction) {
  correction.validate();
  std::unique_ptr<RecordingReader> reader = openAsItIs(path, correction);
  if (correction.camera || correction.depth_unit_m) {
    const double own_unit_m = correction.camera ? correction.camera->depth_unit_m : reader->info().depth_unit_m;
    reader->believe(correctedCamera(reader->info().camera, correction.camera),
                    correction.depth_unit_m.value_or(own_unit_m));
  }
  return turnedRecording(std::move(reader), correction.turn_deg);
}

}  // namespace depthmocap
