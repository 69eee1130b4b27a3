#pragma once
#include "libtracker/body/body_surface.h"
#include "libtracker/core/random.h"

namespace depthmocap {

// A random adult: half of each sex, statures and body mass indices spread as in Western surveys (1.50 .. 2.00 m,
// BMI 17 .. 36), clipped to those ranges.
BodyShape sampleBodyShape(Random& random);

}  // namespace depthmocap
