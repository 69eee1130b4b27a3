#pragma once
#include "depthmocap/marker_set.h"
#include "libtracker/skeleton/forward_kinematics.h"
#include "libtracker/skeleton/marker_model.h"
#include "libtracker/solve/twist_equations.h"

namespace depthmocap {

// lambda2 E_marker of equation (5): lambda * sum over seen markers of confidence * rho(|f(q) - a~|), rho the
// Lorentzian.
class MarkerTerm {
 public:
  // The references must outlive the term.
  MarkerTerm(const MarkerModel& model, const MarkerSet& markers_world, double lambda, double sigma_m)
      : model_(model), markers_(markers_world), lambda_(lambda), sigma_m_(sigma_m) {}

  [[nodiscard]] double energy(const ForwardKinematics& fk) const;
  void addTo(const ForwardKinematics& fk, TwistEquations& equations) const;
  // Confidence-weighted root mean square distance [m] of the seen markers from the model's; 0 if none is seen.
  [[nodiscard]] double rms(const ForwardKinematics& fk) const;

 private:
  const MarkerModel& model_;
  const MarkerSet& markers_;
  double lambda_;
  double sigma_m_;
};

}  // namespace depthmocap
