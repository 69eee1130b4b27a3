#pragma once
#include <Eigen/Core>

#include "depthmocap/pose.h"
#include "depthmocap/skeleton.h"

namespace depthmocap {

// A column a bone: w x y z of its rotation in its parent.
using Quaternions = Eigen::Matrix<double, 4, kBoneCount>;
Quaternions boneRotations(const Pose& q);

}  // namespace depthmocap
