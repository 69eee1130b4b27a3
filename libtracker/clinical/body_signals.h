#pragma once
#include "libtracker/skeleton/forward_kinematics.h"

namespace depthmocap {

// Where hips and feet are, for what angles do not say: steps, jumps, standing up. [m], y up; the world's origin is the
// camera.
struct BodySignals {
  double pelvis_y_m = 0;
  double left_sole_y_m = 0;  // of the lower of heel and toes
  double right_sole_y_m = 0;
  double left_foot_ahead_m = 0;  // of the ankle before the pelvis, in the direction in which the pelvis faces
  double right_foot_ahead_m = 0;
};

// `fk` of this skeleton in a world with y up.
BodySignals bodySignals(const ForwardKinematics& fk, const Skeleton& skeleton);

}  // namespace depthmocap
