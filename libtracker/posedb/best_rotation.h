#pragma once
#include <Eigen/Core>

namespace depthmocap {

// The rotation R that maximises trace(R^T S), S = sum_i w_i a_i b_i^T: it turns the points b_i onto the a_i with the
// least weighted squared distance (both about their weighted centroids). Quaternion method (Horn 1987): the largest
// eigenvalue of Davenport's matrix by Newton's iteration on its characteristic polynomial (Theobald 2005), its
// eigenvector from the adjugate; where that vanishes (points in a line or fewer) by a full eigen-decomposition.
Eigen::Matrix3d bestRotation(const Eigen::Matrix3d& S);

// The same among rotations about the y axis.
Eigen::Matrix3d bestRotationAboutY(const Eigen::Matrix3d& S);

}  // namespace depthmocap
