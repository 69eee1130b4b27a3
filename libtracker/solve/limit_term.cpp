#include "libtracker/solve/limit_term.h"

#include <algorithm>
#include <cmath>

#include "libtracker/skeleton/joint_limits.h"

namespace depthmocap {

LimitTerm::LimitTerm(double lambda) : weight_(std::sqrt(lambda)) {}

void LimitTerm::evaluate(const Pose& q, ResidualRows r, JacobianRows* J) const {
  const JointLimits& limits = jointLimits();
  if (J != nullptr) J->setZero();
  for (int row = 0; row < kRows; ++row) {
    const int dof = kFirstBodyDof + row;
    const double excess = q[dof] - std::clamp(q[dof], limits.lower[dof], limits.upper[dof]);
    r[row] = weight_ * excess;
    if (J != nullptr && excess != 0) (*J)(row, dof) = weight_;
  }
}

}  // namespace depthmocap
