#pragma once
#include "forest/motions/key_poses.h"

namespace depthmocap {

// Hands [m] and stances that many motions share.
inline constexpr HandTarget kAtSide{0.10, -0.52, 0.06, 0.0};
inline constexpr HandTarget kOnHip{0.05, -0.36, 0.02, 0.55};
inline constexpr HandTarget kTPose{0.535, 0.03, 0.0, 0.0};
inline constexpr HandTarget kAPose{0.36, -0.39, 0.02, 0.0};
inline constexpr HandTarget kOverhead{-0.03, 0.60, 0.05, 0.0};
inline constexpr HandTarget kForward{-0.02, -0.02, 0.57, 0.0};
inline constexpr HandTarget kFoldedAtChest{-0.06, -0.06, 0.24, 0.1};

// Standing at ease; x metres wide.
inline KeyPose standing(double half_width = 0.11) {
  KeyPose key;
  key.left_foot.out = key.right_foot.out = half_width;
  return key;
}

// The boxer's stance: left side before, fists before the chin, knees soft.
inline KeyPose boxingGuard() {
  KeyPose key;
  key.left_foot = {.out = 0.12, .forward = 0.20, .toe_out = -0.35};
  key.right_foot = {.out = 0.17, .forward = -0.20, .pitch = 0.15, .toe_out = 0.75};
  key.pelvis.heading = -0.55;
  key.pelvis.y = -0.06;
  key.pelvis.lean = 0.06;
  key.spine = {.bend = 0.15, .twist = 0.05};
  key.head = {.nod = 0.10, .turn = 0.45};
  key.left = {-0.04, 0.02, 0.30, -0.1};
  key.right = {-0.07, 0.03, 0.20, -0.1};
  return key;
}

}  // namespace depthmocap
