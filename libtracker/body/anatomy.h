#pragma once
#include "libtracker/body/body_field.h"
#include "libtracker/body/body_surface.h"
#include "libtracker/skeleton/skeleton.h"

namespace depthmocap {

// The masses of a body in the zero pose, root at the origin. `fatness` 0 is a lean adult; every region grows with it by
// its own rate, which depends on the sex; the useful range is about -0.4 to 2.
BodyField makeAnatomy(Sex sex, const BoneLengths& lengths, double stature_m, double fatness);

}  // namespace depthmocap
