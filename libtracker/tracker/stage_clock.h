#pragma once
#include <chrono>

#include "depthmocap/tracked_frame.h"

namespace depthmocap {

// Adds the wall time between its calls to the stages of one frame.
class StageClock {
 public:
  explicit StageClock(StageTimes& times) { follow(times); }
  // From now on time goes to this frame's stages, all at 0.
  void follow(StageTimes& times) {
    times_ = &times;
    times = StageTimes{};
    start_ = last_ = Clock::now();
  }
  // The time since the last call (or the construction) belonged to `stage`.
  void lap(double StageTimes::*stage) {
    const auto now = Clock::now();
    times_->*stage += milliseconds(now - last_);
    last_ = now;
    times_->total = milliseconds(now - start_);
  }

 private:
  using Clock = std::chrono::steady_clock;
  static double milliseconds(Clock::duration d) { return std::chrono::duration<double, std::milli>(d).count(); }
  StageTimes* times_ = nullptr;
  Clock::time_point start_;
  Clock::time_point last_;
};

}  // namespace depthmocap
