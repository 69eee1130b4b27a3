#pragma once
#include "libtracker/choreography/motion_json.h"
#include "libtracker/choreography/motion_script.h"

namespace depthmocap {

// A list of steps, which may use the given parts. Whatever is wrong is an Error that names the place.
Steps readSteps(const MotionJson& list, const Parts& parts);

}  // namespace depthmocap
