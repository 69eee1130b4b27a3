#include "libtracker/recording/tum_folder.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "depthmocap/error.h"
#include "libtracker/core/check_camera.h"
#include "libtracker/recording/png_file.h"
#include "libtracker/recording/recording_header.h"
#include "libtracker/recording/tum_index.h"
#include "libtracker/recording/usual_camera.h"

namespace depthmocap {

namespace fs = std::filesystem;

namespace {

constexpr double kStepsPerMetre = 5000.0;       // of the benchmark
constexpr double kUsualStepsPerMetre = 1000.0;  // of nearly all cameras
// [m] Where half of what is measured is nearer, no person fits into the picture: 1 m of height in view of a Kinect.
constexpr double kNearestScene_m = 1.0;

// Intrinsics that the benchmark's authors publish: depth is registered to the colour camera. Sequences of the third
// camera are named freiburg3 and were rectified by the authors; for all others they recommend the default of ROS.
CameraModel benchmarkCamera(const fs::path& folder) {
  CameraModel camera;  // 640x480, 525, 319.5, 239.5
  if (fs::weakly_canonical(folder).string().find("freiburg3") != std::string::npos) {
    camera.fx = 535.4;
    camera.fy = 539.2;
    camera.cx = 320.1;
    camera.cy = 247.6;
  }
  return camera;
}

// The first picture that can be read; empty where none can.
Image<std::uint16_t> firstPicture(const std::vector<IndexEntry>& entries) {
  Image<std::uint16_t> picture;
  for (const IndexEntry& entry : entries) {
    try {
      const PngSize size = png16Size(entry.file);
      checkCamera(usualCamera(size.width, size.height), entry.file.string());
      readPng16(entry.file, size.width, size.height, picture);
      return picture;
    } catch (const Error&) {  // NOLINT(bugprone-empty-catch): reading that frame will say so
    }
  }
  return {};
}

// [steps] of what is measured; 0 where nothing is.
double medianDepth(const Image<std::uint16_t>& picture) {
  std::vector<std::uint16_t> measured;
  std::ranges::copy_if(picture.data, std::back_inserter(measured), [](std::uint16_t steps) { return steps > 0; });
  if (measured.empty()) return 0;
  const auto middle = measured.begin() + static_cast<std::ptrdiff_t>(measured.size() / 2);
  std::ranges::nth_element(measured, middle);
  return *middle;
}

void takeCamera(const fs::path& folder, const Image<std::uint16_t>& first, bool known, RecordingInfo& info) {
  info.camera = benchmarkCamera(folder);
  info.camera_name = "kinect1";
  if (first.empty() || (first.width == info.camera.width && first.height == info.camera.height)) return;
  info.camera = usualCamera(first.width, first.height);
  info.camera_name.clear();
  if (known) return;
  info.guesses.push_back(folder.string() + ": a TUM folder does not tell intrinsics: " + guessText(info.camera));
}

void takeUnit(const fs::path& folder, const Image<std::uint16_t>& first, bool known, RecordingInfo& info) {
  info.depth_unit_m = 1.0 / kStepsPerMetre;
  const double median = medianDepth(first);
  if (known || median == 0 || median > kNearestScene_m * kStepsPerMetre) return;
  info.depth_unit_m = 1.0 / kUsualStepsPerMetre;
  info.guesses.push_back(
      fmt::format("{}: with the benchmark's {:g} steps a metre half of the scene would be nearer than {:.2f} m: taken "
                  "for millimetres, "
                  "{:.2f} m; --depth-unit MM says what a step is",
                  folder.string(), kStepsPerMetre, median / kStepsPerMetre, median / kUsualStepsPerMetre));
}

}  // namespace

std::optional<fs::path> tumIndex(const fs::path& folder) {
  for (const char* name : {"depth.txt", "associations.txt"}) {
    if (fs::exists(folder / name)) return folder / name;
  }
  return std::nullopt;
}

std::unique_ptr<RecordingReader> openTumFolder(const fs::path& folder, const fs::path& index,
                                               const RecordingCorrection& correction) {
  TumIndex list = readTumIndex(folder, index);
  const Image<std::uint16_t> first = firstPicture(list.entries);
  RecordingInfo info;
  info.guesses = std::move(list.guesses);
  info.fps = list.fps;
  takeCamera(folder, first, correction.camera.has_value(), info);
  takeUnit(folder, first, correction.camera.has_value() || correction.depth_unit_m.has_value(), info);
  info.note = "TUM RGB-D " + fs::weakly_canonical(folder).filename().string();
  checkRates(info, index.string());
  return std::make_unique<ImageListReader>(std::move(info), std::move(list.entries));
}

}  // namespace depthmocap
