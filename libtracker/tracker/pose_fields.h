#pragma once
#include "depthmocap/actor.h"
#include "depthmocap/tracked_frame.h"
#include "libtracker/skeleton/forward_kinematics.h"

namespace depthmocap {

// Gives a tracked frame this pose, and joints and model markers that agree with it: the one writer of what depends on
// the pose. `q` is in the frame's world; `actor` is the body in use at that frame.
void setPose(const Pose& q, const Actor& actor, ForwardKinematics& fk, TrackedFrame& frame);

}  // namespace depthmocap
