#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <system_error>

#include <fmt/format.h>

#include "libtracker/core/check.h"
#include "libtracker/core/error.h"
#include "libtracker/recording/png_file.h"
#include "libtracker/recording/recording.h"
#include "libtracker/recording/recording_header.h"

namespace depthmocap {

namespace fs = std::filesystem;

namespace {

constexpr double kLargestStep = 65535.0;
constexpr double kTimeSteps = 1e6;  // per second, as many as frames.csv shows

void makeFolder(const fs::path& folder) {
  std::error_code failure;
  if (fs::exists(folder, failure) && !(fs::is_directory(folder, failure) && fs::is_empty(folder, failure))) {
    throw Error("exists already and is not overwritten", folder.string(), "remove it or name a new folder");
  }
  fs::create_directories(folder / "depth", failure);
  if (failure) throw Error("cannot be created: " + failure.message(), folder.string());
}

std::uint16_t toSteps(float depth_m, double depth_unit_m) {
  const double steps = std::round(depth_m / depth_unit_m);
  return steps >= 1.0 && steps <= kLargestStep ? static_cast<std::uint16_t>(steps) : std::uint16_t{0};
}

}  // namespace

struct RecordingWriter::Impl {
  fs::path folder;
  RecordingInfo info;
  fs::path index_file;
  std::int64_t last_frame = -1;
  double last_time_s = 0;
  Image<std::uint16_t> raw;

  void append(const std::string& row) const;
};

// Opened for each row: a row is in the file when write() returns, and a row that did not fit is taken back.
void RecordingWriter::Impl::append(const std::string& row) const {
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

RecordingWriter::RecordingWriter(const fs::path& path, const RecordingInfo& info) : impl_(std::make_unique<Impl>()) {
  impl_->folder = path;
  impl_->info = info;
  impl_->index_file = path / "frames.csv";
  makeFolder(path);
  writeRecordingHeader(path / "recording.json", info);
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
  impl_->last_frame = frame.frame;
  impl_->last_time_s = time_s;
}

}  // namespace depthmocap
