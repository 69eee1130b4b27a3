#pragma once
#include "libtracker/skeleton/forward_kinematics.h"
#include "libtracker/solve/residual_block.h"
#include "libtracker/solve/surface_match.h"

namespace depthmocap {

// Dense term, beyond the paper: lambda * sum over matches of weight * (n . (f(q) - p))^2 / (2 sigma^2), point to plane
// with the matches held fixed. One row a match.
class SurfaceTerm {
 public:
  static constexpr int kRows = kMaxSurfaceMatches;

  // `matches` may be nullptr: no dense term. The references must outlive the term.
  SurfaceTerm(const Skeleton& skeleton, const SurfaceMatches* matches, double lambda, double sigma_m)
      : skeleton_(skeleton), matches_(matches), lambda_(lambda), sigma_m_(sigma_m) {}

  void evaluate(const Pose& q, ResidualRows r, JacobianRows* J);

 private:
  const Skeleton& skeleton_;
  const SurfaceMatches* matches_;
  double lambda_;
  double sigma_m_;
  ForwardKinematics fk_;
};

}  // namespace depthmocap
