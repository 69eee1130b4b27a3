#include "depthmocap/calibration.h"

#include "calibration/calibration_run.h"
#include "libtracker/core/check_camera.h"

namespace depthmocap {
namespace {

const CameraModel& checked(const CameraModel& camera) {
  checkCamera(camera, "CameraModel");
  return camera;
}

CalibrationRunConfig configOf(const CalibrationOptions& options) {
  CalibrationRunConfig config;
  config.calibrator.frames = options.frames;
  config.calibrator.stature_m = options.stature_m;
  config.calibrator.threads = options.threads;
  config.camera_name = options.camera_name;
  return config;
}

}  // namespace

struct Calibration::Impl {
  CameraModel camera;
  CalibrationRun run;
};

Calibration::Calibration(const Models& models, const CameraModel& camera, const CalibrationOptions& options)
    : impl_(
          new Impl{checked(camera), CalibrationRun(models, loadCalibratorModels(models), camera, configOf(options))}) {}
Calibration::~Calibration() = default;
Calibration::Calibration(Calibration&&) noexcept = default;
Calibration& Calibration::operator=(Calibration&&) noexcept = default;

CalibrationAdvice Calibration::add(const DepthFrame& frame) {
  checkFrame(frame, impl_->camera);
  const TPoseVerdict verdict = impl_->run.add(frame);
  return {verdict.good(), verdict.advice, impl_->run.goodFrames()};
}

bool Calibration::enough() const {
  return impl_->run.enough();
}

Actor Calibration::solve() {
  return solve([](const auto&) {});
}

Actor Calibration::solve(const Frames& others) {
  return impl_->run.solve(others);
}

}  // namespace depthmocap
