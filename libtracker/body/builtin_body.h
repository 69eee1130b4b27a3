#pragma once
#include "libtracker/body/body_surface.h"
#include "libtracker/skeleton/typical_bone_lengths.h"

namespace depthmocap {

// The parametric human that needs no files: a smooth union of anatomical masses placed by the joints.
// Proportions by sex after Drillis and Contini (1966), de Leva (1996) and the girths of ANSUR (1988); girths grow until
// the volume matches the weight. About 20,000 triangles, less than a second. Throws Error when a value of the shape is
// outside its range.
BodySurface makeBuiltinBody(const BodyShape& shape);

// The same around given bone lengths; shape.stature_m is the height of the flesh.
BodySurface makeBuiltinBody(const BodyShape& shape, const BoneLengths& lengths);

// A man of ordinary weight around given bone lengths: what a tracked skeleton is shown with.
BodySurface makeBuiltinBody(const BoneLengths& lengths);

}  // namespace depthmocap
