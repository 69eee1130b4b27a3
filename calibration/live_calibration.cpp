#include "calibration/live_calibration.h"

#include <chrono>
#include <cmath>

#include <fmt/format.h>

#include "depthmocap/error.h"
#include "libtracker/core/background.h"

namespace depthmocap {
namespace {

constexpr double kCountdown_s = 3.0;
constexpr double kPatience_s = 30.0;  // after the countdown

template <typename Result>
bool isReady(const std::future<Result>& future) {
  return future.valid() && future.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

}  // namespace

LiveCalibration::LiveCalibration(const Models& tracking, const CameraModel& camera, const CalibrationRunConfig& config)
    : loading_(std::async(std::launch::async,
                          [=] {
                            runInBackground();
                            return std::make_unique<CalibrationRun>(tracking, loadCalibratorModels(tracking), camera,
                                                                    config);
                          })),
      text_("Stand upright, facing the camera, arms out to the sides.") {}

LiveCalibration::~LiveCalibration() = default;

bool LiveCalibration::say(const std::string& text) {
  if (text == text_) return false;
  text_ = text;
  return true;
}

bool LiveCalibration::add(const DepthFrame& frame) {
  if (solving_.valid()) return false;
  if (!start_s_) start_s_ = frame.time_s;
  others_.add(frame);
  const double elapsed_s = frame.time_s - *start_s_;
  if (elapsed_s < kCountdown_s) {
    return say(fmt::format("Calibrating in {:.0f}: stand upright, facing the camera, arms out to the sides.",
                           std::ceil(kCountdown_s - elapsed_s)));
  }
  if (isReady(loading_)) run_ = loading_.get();
  if (!run_) return say("Loading what a calibration needs.");
  if (elapsed_s > kCountdown_s + kPatience_s) throw Error("no T-pose was seen in time", "calibration", text_);
  const TPoseVerdict verdict = run_->add(frame);
  if (run_->enough()) {
    startSolving();
    return say("Thank you, measuring; you may move.");
  }
  if (!verdict.good()) return say(verdict.advice + ".");
  return say(fmt::format("Good, hold still: {} frames.", run_->goodFrames()));
}

void LiveCalibration::startSolving() {
  solving_ = std::async(std::launch::async, [run = std::move(run_), others = std::move(others_)]() mutable {
    runInBackground();
    return run->solve(others);
  });
}

std::optional<Actor> LiveCalibration::finished() {
  if (!isReady(solving_)) return std::nullopt;
  return solving_.get();
}

}  // namespace depthmocap
