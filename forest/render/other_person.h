#pragma once
#include <vector>

#include "forest/render/staging.h"

namespace depthmocap {

// Somebody else in the view: person 2, 3 and so on of the truth.
struct OtherPerson {
  MotionClip clip;  // played once from the first frame on; the last pose stays
  BodySurface body;
  StagingConfig staging;
  double aside_m = 0;  // [m] moved to the right in the picture
  double apart_m = 0;  // [m] moved aside until the pelvis stays this far from the actor's, 0 = not moved
};

// The poses of that one beside an actor, in the actor's world; at least one.
std::vector<Pose> stageOther(const OtherPerson& other, const StagedMotion& actor);

}  // namespace depthmocap
