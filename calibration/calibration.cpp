#include "depthmocap/calibration.h"

#include "calibration/calibration_run.h"

namespace depthmocap {
namespace {

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
  CalibrationRun run;
};

Calibration::Calibration(const Models& models, const CameraModel& camera, const CalibrationOptions& options)
    : impl_(new Impl{CalibrationRun(models, loadCalibratorModels(models), camera, configOf(options))}) {}
Calibration::~Calibration() = default;
Calibration::Calibration(Calibration&&) noexcept = default;
Calibration& Calibration::operator=(Calibration&&) noexcept = default;

CalibrationAdvice Calibration::add(const DepthFrame& frame) {
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
