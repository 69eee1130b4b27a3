#pragma once
#include "depthmocap/marker_set.h"
#include "libtracker/skeleton/forward_kinematics.h"
#include "libtracker/skeleton/marker_model.h"
#include "libtracker/solve/residual_block.h"

namespace depthmocap {

// lambda2 E_marker of equation (5): sum over seen markers of lambda * confidence * rho(|f(q) - a~|), rho the
// Lorentzian.
//
// Rows: three per marker, then one per marker for its curvature (see RobustPull).
class MarkerTerm {
 public:
  static constexpr int kResidualRows = 3 * kPartCount;
  static constexpr int kRows = kResidualRows + kPartCount;

  // The references must outlive the term.
  MarkerTerm(const Skeleton& skeleton, const MarkerModel& model, const MarkerSet& markers_world, double lambda,
             double sigma_m)
      : skeleton_(skeleton), model_(model), markers_(markers_world), lambda_(lambda), sigma_m_(sigma_m) {}

  void evaluate(const Pose& q, ResidualRows r, JacobianRows* J);
  // Confidence-weighted root mean square distance [m] of the seen markers from the model's at q; 0 if none is seen.
  [[nodiscard]] double rms(const Pose& q);

 private:
  const Skeleton& skeleton_;
  const MarkerModel& model_;
  const MarkerSet& markers_;
  double lambda_;
  double sigma_m_;
  ForwardKinematics fk_;
};

}  // namespace depthmocap
