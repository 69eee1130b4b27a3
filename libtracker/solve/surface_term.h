#pragma once
#include "libtracker/skeleton/forward_kinematics.h"
#include "libtracker/skeleton/surface_match.h"
#include "libtracker/solve/twist_equations.h"

namespace depthmocap {

// Dense term, beyond the paper: lambda * sum over matches of weight * (n . (f(q) - p))^2 / (2 sigma^2), point to plane
// with the matches held fixed.
class SurfaceTerm {
 public:
  // `matches` may be nullptr: no dense term; they must outlive the term.
  SurfaceTerm(const SurfaceMatches* matches, double lambda, double sigma_m)
      : matches_(matches), scale_(lambda / (2.0 * sigma_m * sigma_m)) {}

  [[nodiscard]] double energy(const ForwardKinematics& fk) const;
  void addTo(const ForwardKinematics& fk, TwistEquations& equations) const;

 private:
  const SurfaceMatches* matches_;
  double scale_;  // [1/m^2]
};

}  // namespace depthmocap
