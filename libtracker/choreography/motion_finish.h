#pragma once
#include <vector>

#include "depthmocap/pose.h"
#include "libtracker/choreography/body_frame.h"
#include "libtracker/core/random.h"
#include "libtracker/skeleton/skeleton.h"

namespace depthmocap {

// What a motion's author hands over.
struct RawMotion {
  BodyFrames frames;
  double liveliness = 1.0;  // scales the natural noise
};

// Adds body sway and small unsteadiness, keeps the balance, lowers the pelvis where legs would be too short, and solves
// every frame. Feet are not disturbed, so planted feet stay planted.
std::vector<Pose> finishMotion(const Skeleton& skeleton, RawMotion motion, Random& random);

}  // namespace depthmocap
