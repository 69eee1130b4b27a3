#pragma once
#include "depthmocap/pose.h"
#include "libtracker/core/facing.h"

namespace depthmocap {

// Where the camera, on the vertical through the world's origin, stands as seen by the actor: [rad] about the vertical,
// 0 = in front, positive towards the actor's left, in (-pi, pi].
double cameraBearing(const Pose& q_world);

// The side that is seen: the nearest quarter turn.
Facing facingOf(const Pose& q_world);

// What a pose that is probably right says of the facing, before an image is looked at; never 0.
FacingShares expectedFacing(const Pose& q_world);

}  // namespace depthmocap
