#pragma once
#include "libtracker/skeleton/normal_equations.h"

namespace depthmocap {

// Joint limits, beyond the paper: lambda times the squared excess [rad^2] of each DoF over its anatomical range
// (skeleton/joint_limits.h), but for those of the root.
class LimitTerm {
 public:
  explicit LimitTerm(double lambda) : lambda_(lambda) {}

  [[nodiscard]] double energy(const Pose& q) const;
  void addTo(const Pose& q, NormalEquations& equations) const;

 private:
  double lambda_;
};

}  // namespace depthmocap
