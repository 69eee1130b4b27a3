#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <system_error>

#include <fmt/format.h>

#include "depthmocap/error.h"
#include "libtracker/core/check.h"
#include "libtracker/recording/png_file.h"
#include "libtracker/recording/recording.h"
#include "libtracker/recording/recording_header.h"

namespace depthmocap {

namespace fs = std::filesystem;

namespace {

constexpr double kLargestStep = 65535.0;
constexpr double kTimeSteps = 1e6;  // per second, as many as frames.csv shows

void refuseToOverwrite(const fs::path& folder, const std::string& advice) {
  std::error_code failure;
  if (fs::exists(folder, failure) && !(fs::is_directory(folder, failure) && fs::is_empty(folder, failure))) {
    throw Error("exists already and is not overwritten", folder.string(), advice);
  }
}

fs::path waitingName(fs::path folder) {
  return folder += ".partial";
}

void makeFolder(const fs::path& folder) {
  std::error_code failure;
  fs::create_directories(folder / "depth", failure);
  if (failure) throw Error("cannot be created: " + failure.message(), folder.string());
}

std::uint16_t toSteps(float depth_m, double depth_unit_m) {
  const double steps = std::round(depth_m / depth_unit_m);
  return steps >= 1.0 && steps <= kLargestStep ? static_cast<std::uint16_t>(steps) : std::uint16_t{0};
}

}  // namespace

struct RecordingWriter::Impl {
  Impl() = default;
  ~Impl() {
    std::error_code unused;
    if (waiting) fs::remove_all(folder, unused);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  fs::path name;         // of the recording
  fs::path folder;       // where it is now
  bool waiting = false;  // for the first frame, in a folder of another name
  RecordingInfo info;
  std::int64_t last_frame = -1;
  double last_time_s = 0;
  Image<std::uint16_t> raw;

  void append(const std::string& row) const;
  void appear();
};

// Opened for each row: a row is in the file when write() returns, and a row that did not fit is taken back.
void RecordingWriter::Impl::append(const std::string& row) const {
  const fs::path index_file = folder / "frames.csv";
  std::error_code unused;
  const std::uintmax_t size_before = fs::exists(index_file, unused) ? fs::file_size(index_file, unused) : 0;
  std::FILE* file = std::fopen(index_file.c_str(), "ab");
  const bool written = file != nullptr && std::fwrite(row.data(), 1, row.size(), file) == row.size();
  const bool closed = file != nullptr && std::fclose(file) == 0;
  if (written && closed) return;
  const int reason = errno;
  if (file != nullptr) fs::resize_file(index_file, size_before, unused);
  throw Error(std::string("cannot be written: ") + std::strerror(reason), index_file.string());
}

void RecordingWriter::Impl::appear() {
  std::error_code failure;
  fs::rename(folder, name, failure);
  if (failure) throw Error("cannot be created: " + failure.message(), name.string());
  folder = name;
  waiting = false;
}

RecordingWriter::RecordingWriter(const fs::path& path, const RecordingInfo& info, Appears appears)
    : impl_(std::make_unique<Impl>()) {
  impl_->name = path.has_filename() ? path : path.parent_path();  // "take/" is "take"
  impl_->info = info;
  impl_->folder = impl_->name;
  refuseToOverwrite(impl_->name, "remove it or name a new folder");
  if (appears == Appears::WithFirstFrame) {
    impl_->folder = waitingName(impl_->name);
    refuseToOverwrite(impl_->folder, "a recording that ended before its first frame left it; remove it");
  }
  makeFolder(impl_->folder);
  impl_->waiting = appears == Appears::WithFirstFrame;
  writeRecordingHeader(impl_->folder / "recording.json", info);
  impl_->append("frame,time_s,file\n");
}

RecordingWriter::~RecordingWriter() = default;

void RecordingWriter::write(const DepthFrame& frame) {
  const CameraModel& camera = impl_->info.camera;
  DMC_CHECK(frame.depth.width == camera.width && frame.depth.height == camera.height);
  const double time_s = std::round(frame.time_s * kTimeSteps) / kTimeSteps;
  const bool first = impl_->last_frame < 0;
  if (frame.frame < 0 || (!first && (frame.frame <= impl_->last_frame || !(time_s > impl_->last_time_s)))) {
    throw Error(fmt::format("frame {} at {:.6f} s does not follow frame {} at {:.6f} s", frame.frame, frame.time_s,
                            impl_->last_frame, impl_->last_time_s),
                impl_->folder.string(), "frame numbers and times must grow");
  }
  impl_->raw.reset(camera.width, camera.height, 0);
  for (std::size_t i = 0; i < frame.depth.data.size(); ++i) {
    impl_->raw.data[i] = toSteps(frame.depth.data[i], impl_->info.depth_unit_m);
  }
  const std::string name = fmt::format("depth/{:06d}.png", frame.frame);
  writePng16(impl_->folder / name, impl_->raw);
  impl_->append(fmt::format("{},{:.6f},{}\n", frame.frame, time_s, name));
  if (impl_->waiting) impl_->appear();
  impl_->last_frame = frame.frame;
  impl_->last_time_s = time_s;
}

}  // namespace depthmocap
