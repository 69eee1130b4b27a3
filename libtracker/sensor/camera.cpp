#include "depthmocap/camera.h"

#include <utility>

#include "libtracker/sensor/depth_source.h"
#include "libtracker/sensor/driver_table.h"
#include "libtracker/sensor/open_source.h"

namespace depthmocap {
namespace {

SourceOptions sourceOptions(const CameraOptions& options) {
  SourceOptions source;
  source.mode = options.mode;
  source.pixel_format = options.pixel_format;
  source.speed = options.speed;
  const RecordingCorrection correction = readCorrection(options.correction);
  source.camera = correction.camera;
  source.depth_unit_m = correction.depth_unit_m;
  source.turn_deg = correction.turn_deg;
  return source;
}

}  // namespace

Camera::Camera(const std::string& source, const CameraOptions& options)
    : source_(openSource(source, sourceOptions(options))) {}
Camera::~Camera() = default;
Camera::Camera(Camera&&) noexcept = default;
Camera& Camera::operator=(Camera&&) noexcept = default;

std::vector<FoundCamera> Camera::list() {
  return cameraDrivers().list();
}

const CameraModel& Camera::model() const {
  return source_->info().camera;
}

double Camera::fps() const {
  return source_->info().fps;
}

const std::string& Camera::name() const {
  return source_->info().camera_name;
}

SourceState Camera::next(DepthFrame& frame, std::chrono::milliseconds timeout) {
  SensorFrame taken;
  std::swap(taken.depth.depth.data, frame.depth.data);  // memory to reuse
  const SourceState state = source_->next(taken, timeout);
  if (state == SourceState::Frame) {
    frame = std::move(taken.depth);
  } else {
    std::swap(taken.depth.depth.data, frame.depth.data);
  }
  return state;
}

std::string Camera::problem() const {
  return source_->problem();
}

}  // namespace depthmocap
