#pragma once
#include "depthmocap/pose.h"

namespace depthmocap {

// Anatomical range of each DoF [rad] (translations and the root: unlimited, +-1e9). Left is the mirror of right.
struct JointLimits {
  Pose lower;
  Pose upper;
};
const JointLimits& jointLimits();

// q with every DoF moved to the nearest value within its range.
Pose clampedToLimits(const Pose& q);

}  // namespace depthmocap
