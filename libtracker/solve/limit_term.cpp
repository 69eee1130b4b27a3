#include "libtracker/solve/limit_term.h"

#include <algorithm>

#include "libtracker/skeleton/joint_limits.h"

namespace depthmocap {
namespace {

// [rad] beyond the range; 0 within.
double excessOf(const Pose& q, int dof) {
  const JointLimits& limits = jointLimits();
  return q[dof] - std::clamp(q[dof], limits.lower[dof], limits.upper[dof]);
}

}  // namespace

double LimitTerm::energy(const Pose& q) const {
  double sum = 0;
  for (int dof = kFirstBodyDof; dof < kDofCount; ++dof) {
    const double excess = excessOf(q, dof);
    sum += excess * excess;
  }
  return lambda_ * sum;
}

void LimitTerm::addTo(const Pose& q, NormalEquations& equations) const {
  for (int dof = kFirstBodyDof; dof < kDofCount; ++dof) {
    const double excess = excessOf(q, dof);
    if (excess == 0) continue;
    equations.g[dof] += lambda_ * excess;
    equations.A(dof, dof) += lambda_;
  }
}

}  // namespace depthmocap
