#pragma once
#include "libtracker/solve/residual_block.h"

namespace depthmocap {

// Joint limits, beyond the paper: lambda times the squared excess [rad^2] of each DoF over its anatomical range
// (skeleton/joint_limits.h). One row a body DoF; zero, with a zero Jacobian, within the range.
class LimitTerm {
 public:
  static constexpr int kRows = kDofCount - kFirstBodyDof;

  explicit LimitTerm(double lambda);
  void evaluate(const Pose& q, ResidualRows r, JacobianRows* J) const;

 private:
  double weight_;
};

}  // namespace depthmocap
