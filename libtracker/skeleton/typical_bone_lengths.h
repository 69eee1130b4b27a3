#pragma once
#include "depthmocap/body_shape.h"
#include "depthmocap/bone_lengths.h"

namespace depthmocap {

// Bone lengths [m] of an adult of this sex and stature [m].
BoneLengths typicalBoneLengths(Sex sex, double stature_m);

}  // namespace depthmocap
