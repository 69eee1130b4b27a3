#pragma once
#include "depthmocap/pose.h"

namespace depthmocap {

// What inverse kinematics found.
struct IkResult {
  Pose q = Pose::Zero();  // world, y up; within joint limits, heading in (-pi, pi]
  double residual_m = 0;  // [m] root mean square distance of the targets from their joints
  int iterations = 0;     // of the solver, those that led nowhere included
};

}  // namespace depthmocap
