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
  lambda_ = lambda;
  expected_ = *q_prev;
  if (q_prev2 == nullptr) return;
  Pose step = *q_prev - *q_prev2;
  step[kRootRy] = wrappedAngle(step[kRootRy]);
  expected_ += velocity_gain * step;
}

Pose SmoothTerm::offset(const Pose& q) const {
  Pose off = q - expected_;
  off[kRootRy] = wrappedAngle(off[kRootRy]);
  return off;
}

void SmoothTerm::addTo(const Pose& q, NormalEquations& equations) const {
  equations.g += lambda_ * offset(q);
  equations.A.diagonal().array() += lambda_;
}

}  // namespace depthmocap
