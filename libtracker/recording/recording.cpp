#include "depthmocap/recording.h"

#include <fmt/format.h>

#include "depthmocap/error.h"
#include "libtracker/recording/recording.h"

namespace depthmocap {
namespace {

void checkIndex(std::size_t i, std::size_t count) {
  if (i >= count) throw Error(fmt::format("there is no frame {} of {}", i, count), "Recording");
}

}  // namespace

Recording::Recording(const std::filesystem::path& path, const CameraCorrection& correction)
    : reader_(openRecording(path, readCorrection(correction))) {}
Recording::~Recording() = default;
Recording::Recording(Recording&&) noexcept = default;
Recording& Recording::operator=(Recording&&) noexcept = default;

const CameraModel& Recording::camera() const {
  return reader_->info().camera;
}

double Recording::fps() const {
  return reader_->info().fps;
}

const std::string& Recording::cameraName() const {
  return reader_->info().camera_name;
}

std::size_t Recording::frameCount() const {
  return reader_->frameCount();
}

std::int64_t Recording::frameNumber(std::size_t i) const {
  checkIndex(i, frameCount());
  return reader_->frameNumber(i);
}

double Recording::time_s(std::size_t i) const {
  checkIndex(i, frameCount());
  return reader_->time(i);
}

DepthFrame Recording::read(std::size_t i) {
  DepthFrame frame;
  read(i, frame);
  return frame;
}

void Recording::read(std::size_t i, DepthFrame& frame) {
  checkIndex(i, frameCount());
  reader_->read(i, frame);
}

}  // namespace depthmocap
