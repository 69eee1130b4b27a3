#pragma once
#include <chrono>

#include "depthmocap/tracked_frame.h"

namespace depthmocap {

// Adds the wall time between its calls to the stages of one frame.
class StageClock {
 public:
  explicit StageClock(StageTimes& times) : times_(times) {
    times_ = StageTimes{};
    start_ = last_ = Clock::now();
  }
  // The time since the last call (or the construction) belonged to `stage`.
  void lap(double StageTimes::*stage) {
    const auto now = Clock::now();
    times_.*stage += milliseconds(now - last_);
    last_ = now;
    times_.total = milliseconds(now - start_);
  }

 private:
  using Clock = std::chrono::steady_clock;
  static double milliseconds(Clock::duration d) { return std::chrono::duration<double, std::milli>(d).count(); }
  StageTimes& times_;
  Clock::time_point start_;
  Clock::time_point last_;
};

}  // namespace depthmocap
