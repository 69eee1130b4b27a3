#pragma once
#include <cstdint>
#include <deque>

#include "depthmocap/depth_frame.h"

namespace depthmocap {

// What an actor does before and between the good frames of a calibration by camera, for other poses than the T-pose:
// every third frame, since neighbours hardly differ, and of these the last 60 (6 s, 74 MB of VGA depth).
class OtherFrames {
 public:
  void add(const DepthFrame& frame) {
    if (seen_++ % kKeepEvery != 0) return;
    kept_.push_back(frame);
    if (kept_.size() > kMostKept) kept_.pop_front();
  }
  // Calls `visit` with each kept frame, in order; as CalibrationRun::Frames.
  template <typename Visit>
  void operator()(const Visit& visit) const {
    for (const DepthFrame& frame : kept_) visit(frame);
  }

 private:
  static constexpr std::int64_t kKeepEvery = 3;
  static constexpr std::size_t kMostKept = 60;
  std::deque<DepthFrame> kept_;
  std::int64_t seen_ = 0;
};

}  // namespace depthmocap
