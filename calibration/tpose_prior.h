#pragma once
#include "calibration/pose_observation.h"
#include "calibration/tpose_check.h"
#include "libtracker/skeleton/skeleton.h"

namespace depthmocap {

// Sets what is known of an actor's pose before looking closer: a T-pose at the outline's place and heading, and how far
// each joint of a person who is asked for one strays from it. Elbows and knees are straight.
void setTPosePrior(const BoneLengths& lengths, const BodyOutline& outline, PoseObservation& observation);

}  // namespace depthmocap
