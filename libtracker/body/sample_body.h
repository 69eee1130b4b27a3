#pragma once
#include "libtracker/body/body_surface.h"
#include "libtracker/body/makehuman_model.h"
#include "libtracker/core/random.h"

namespace depthmocap {

// A random adult: half of each sex, statures and body mass indices spread as in Western surveys (1.50 .. 2.00 m,
// BMI 17 .. 36), clipped to those ranges.
BodyShape sampleBodyShape(Random& random);

// The same for MakeHuman's macros: mostly clear sexes, ages 25 .. 85, mixed races, statures as above.
MakeHumanShape sampleMakeHumanShape(Random& random);

// A random person in random clothes: a built-in body, or with a model one of MakeHuman's for every second person.
// `makehuman` may be null.
BodySurface sampleDressedBody(Random& random, const MakeHumanModel* makehuman);

}  // namespace depthmocap
