#pragma once
#include <Eigen/Core>
#include <array>

#include "depthmocap/pose.h"

namespace depthmocap {

// The DoFs that say how the body is bent and tilted, not where it stands: all but root translation and heading. Only
// these enter the pose distance of equation (3) and the local prior.
inline constexpr int kShapeDofCount = kDofCount - 4;
inline constexpr std::array<int, kShapeDofCount> kShapeDofs = [] {
  std::array<int, kShapeDofCount> dofs{};
  std::size_t next = 0;
  for (int i = kFirstRotationDof; i < kDofCount; ++i) {
    if (i != kRootRy) dofs[next++] = i;
  }
  return dofs;
}();

inline constexpr int kMaxPriorDims = kShapeDofCount;  // B; the paper takes at most 7

// Local linear model (4): q = mean + basis * phi + residual, over kShapeDofs; the other rows of mean and basis are zero
// and never enter the prior. With residual_rad = 0 every phi is as likely, the paper's subspace; else the poses around
// q are a Gaussian with covariance basis diag(deviation^2) basis^T + residual_rad^2 I. A plain struct below the stages,
// so that the stage that makes it and the one that uses it need not meet.
struct LocalPrior {
  Pose mean = Pose::Zero();
  // Orthonormal columns; the first `dims` are used.
  Eigen::Matrix<double, kDofCount, kMaxPriorDims> basis = Eigen::Matrix<double, kDofCount, kMaxPriorDims>::Zero();
  // Standard deviation of the neighbours along each column [rad].
  Eigen::Matrix<double, kMaxPriorDims, 1> deviation = Eigen::Matrix<double, kMaxPriorDims, 1>::Zero();
  double residual_rad = 0;  // [rad] deviation in every direction beside that of the columns
  int dims = 0;             // B
  int neighbours = 0;       // K
};

}  // namespace depthmocap
