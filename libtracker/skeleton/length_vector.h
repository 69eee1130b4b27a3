#pragma once
#include <Eigen/Core>

#include "depthmocap/bone_lengths.h"

namespace depthmocap {

// Bone lengths as a vector [m], in the order of kBoneLengthFields.
using LengthVector = Eigen::Matrix<double, kBoneLengthCount, 1>;
LengthVector lengthVector(const BoneLengths& lengths);
BoneLengths boneLengths(const LengthVector& s);

}  // namespace depthmocap
