#pragma once
#include "libtracker/choreography/motion_finish.h"
#include "libtracker/choreography/motion_script.h"

namespace depthmocap {

// Performs a motion with the draws of `random`; `variant` (0, 1, ...) is a name in its formulas. Error naming file,
// motion and step for what only shows on the way: a name that is not known, a key that is not after the one before, a
// motion that has no frames or does not end.
RawMotion playMotion(const MotionScript& motion, const Places& places, int variant, const Skeleton& skeleton,
                     Random& random);

}  // namespace depthmocap
