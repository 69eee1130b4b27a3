#include "libtracker/solve/smooth_term.h"

#include <cmath>
#include <numbers>

namespace depthmocap {

double wrappedAngle(double angle) {
  constexpr double kPi = std::numbers::pi;
  const double wrapped = std::remainder(angle, 2.0 * kPi);
  return wrapped <= -kPi ? kPi : wrapped;
}

SmoothTerm::SmoothTerm(const Pose* q_prev, const Pose* q_prev2, double velocity_gain, double lambda) {
  if (q_prev == nullptr) return;
  weight_ = std::sqrt(lambda);
  expected_ = *q_prev;
  if (q_prev2 == nullptr) return;
  Pose step = *q_prev - *q_prev2;
  step[kRootRy] = wrappedAngle(step[kRootRy]);
  expected_ += velocity_gain * step;
}

void SmoothTerm::evaluate(const Pose& q, ResidualRows r, JacobianRows* J) const {
  r = weight_ * (q - expected_);
  r[kRootRy] = weight_ * wrappedAngle(q[kRootRy] - expected_[kRootRy]);
  if (J == nullptr) return;
  J->setZero();
  J->diagonal().setConstant(weight_);
}

}  // namespace depthmocap
