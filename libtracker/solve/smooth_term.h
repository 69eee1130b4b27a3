#pragma once
#include "libtracker/skeleton/normal_equations.h"

namespace depthmocap {

// lambda3 E_smooth of equation (5): lambda * || q - 2 q_-1 + q_-2 ||^2, [m^2] and [rad^2] as in the paper; the
// heading's differences are taken around the circle.
class SmoothTerm {
 public:
  // q_prev2 nullptr: no motion is expected; both nullptr: no term. velocity_gain (>= 0): how many times the step from
  // q_prev2 to q_prev is expected again; 1 gives the paper's term, the ratio of the frame times keeps the velocity at
  // uneven times.
  SmoothTerm(const Pose* q_prev, const Pose* q_prev2, double velocity_gain, double lambda);

  [[nodiscard]] double energy(const Pose& q) const { return lambda_ * offset(q).squaredNorm(); }
  void addTo(const Pose& q, NormalEquations& equations) const;

 private:
  [[nodiscard]] Pose offset(const Pose& q) const;  // from the expected pose

  Pose expected_ = Pose::Zero();
  double lambda_ = 0;
};

// angle - 2 pi k in (-pi, pi] [rad].
double wrappedAngle(double angle);

}  // namespace depthmocap
