#pragma once
#include <array>

#include "libtracker/skeleton/forward_kinematics.h"
#include "libtracker/skeleton/surface_match.h"
#include "libtracker/solve/residual_block.h"

namespace depthmocap {

// Dense term, beyond the paper: lambda * sum over matches of weight * (n . (f(q) - p))^2 / (2 sigma^2), point to plane
// with the matches held fixed.
//
// A point that is rigid with a bone depends linearly on the 12 numbers of the bone's frame, so the sum over all matches
// of a bone is a quadratic form of these and 1. Its root, 13 rows a bone, gives the same energy and the same normal
// equations as one row per match would: the solve takes the same time for any number of matches.
class SurfaceTerm {
 public:
  static constexpr int kBoneRows = 13;
  static constexpr int kRows = kBoneRows * kBoneCount;

  // `matches` may be nullptr: no dense term; it is read here only. The skeleton must outlive the term.
  SurfaceTerm(const Skeleton& skeleton, const SurfaceMatches* matches, double lambda, double sigma_m);

  void evaluate(const Pose& q, ResidualRows r, JacobianRows* J);

 private:
  using BoneMatrix = Eigen::Matrix<double, kBoneRows, kBoneRows>;
  struct BoneForm {
    bool matched = false;
    BoneMatrix root;  // of the sum of squares, over (columns of R_world_bone, origin, 1)
  };

  const Skeleton& skeleton_;
  bool matched_ = false;  // any bone
  std::array<BoneForm, kBoneCount> forms_;
  ForwardKinematics fk_;
};

}  // namespace depthmocap
