#include "libtracker/solve/surface_term.h"

namespace depthmocap {

double SurfaceTerm::energy(const ForwardKinematics& fk) const {
  if (matches_ == nullptr) return 0;
  double sum = 0;
  for (const SurfaceMatch& match : *matches_) {
    const double off = match.n_world.dot(fk.position(match.model) - match.p_world);
    sum += match.weight * off * off;
  }
  return scale_ * sum;
}

void SurfaceTerm::addTo(const ForwardKinematics& fk, TwistEquations& equations) const {
  if (matches_ == nullptr) return;
  for (const SurfaceMatch& match : *matches_) {
    const Eigen::Vector3d p = fk.position(match.model);
    const double off = match.n_world.dot(p - match.p_world);
    equations.addPlane(match.model.bone, p, match.n_world, off, scale_ * match.weight);
  }
}

}  // namespace depthmocap
