#pragma once
#include <Eigen/Core>
#include <vector>

#include "libtracker/posedb/pose_database.h"
#include "libtracker/posedb/pose_search.h"
#include "libtracker/skeleton/dof.h"

namespace depthmocap {

inline constexpr int kMaxPriorDims = 7;  // the paper's bound on B

// Local linear model (4): q = mean + basis * phi, over the DoFs that do not depend on where the actor stands (root
// translation and heading have zero rows and never enter the prior).
struct LocalPrior {
  Pose mean = Pose::Zero();
  Eigen::Matrix<double, kDofCount, kMaxPriorDims> basis = Eigen::Matrix<double, kDofCount, kMaxPriorDims>::Zero();
  int dims = 0;        // B: used columns of basis (orthonormal)
  int neighbours = 0;  // K
};

struct PriorConfig {
  std::vector<int> neighbours = {15, 30, 50};  // K to choose from, ascending (paper: <= 50)
  std::vector<int> dims = {3, 5, 7};           // B to choose from, ascending (paper: <= 7)
  void validate() const;
};

}  // namespace depthmocap
