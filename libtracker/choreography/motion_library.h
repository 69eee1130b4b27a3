#pragma once
#include <vector>

#include "libtracker/choreography/motion_script.h"

namespace depthmocap {

// The motion files that are built in, libtracker/choreography/motions, in the order in which they are performed; read
// and checked once.
const std::vector<MotionFile>& motionLibrary();

}  // namespace depthmocap
