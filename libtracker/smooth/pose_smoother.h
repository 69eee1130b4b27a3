#pragma once
#include <vector>

#include "depthmocap/pose.h"
#include "libtracker/smooth/one_euro.h"

namespace depthmocap {

// Calms a stream of poses with a One-Euro filter on each degree of freedom. One knob; what it costs in delay and gains
// in calm is measured in docs/lab/smoothing.md.
class PoseSmoother {
 public:
  // `strength` in [0, 1]; 0 leaves poses as they are.
  explicit PoseSmoother(double strength);
  // The smoothed pose at `time_s` [s], which must grow from pose to pose.
  Pose smooth(const Pose& q, double time_s);
  // After a loss: the next pose starts anew.
  void reset();
  [[nodiscard]] bool on() const { return !filters_.empty(); }

 private:
  std::vector<OneEuro> filters_;  // one per DoF; empty = off
  bool started_ = false;
  double heading_ = 0;  // [rad] of the pose before, without jumps at half turns
};

}  // namespace depthmocap
