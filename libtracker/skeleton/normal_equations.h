#pragma once
#include <Eigen/Core>

#include "depthmocap/pose.h"

namespace depthmocap {

using PoseMatrix = Eigen::Matrix<double, kDofCount, kDofCount>;

// The quadratic model of an energy about a pose: E(q + d) ~ energy + 2 g^T d + d^T A d. For E = |r(q)|^2 that is g =
// J^T r and A = J^T J. Each term of equation (5) adds its own, lambda included. Plain data below the stages: the solve
// makes it, and what joins the frames of a recording uses it.
struct NormalEquations {
  double energy = 0;
  Pose g = Pose::Zero();
  PoseMatrix A = PoseMatrix::Zero();  // symmetric; the lower triangle is filled

  void reset() {
    energy = 0;
    g.setZero();
    A.setZero();
  }
};

}  // namespace depthmocap
