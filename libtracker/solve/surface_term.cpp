#include "libtracker/solve/surface_term.h"

#include <cmath>

namespace depthmocap {

void SurfaceTerm::evaluate(const Pose& q, ResidualRows r, JacobianRows* J) {
  r.setZero();
  if (J != nullptr) J->setZero();
  if (matches_ == nullptr) return;
  fk_.update(skeleton_, q);
  const double scale = std::sqrt(lambda_ / 2.0) / sigma_m_;
  Eigen::Index row = 0;
  for (const SurfaceMatch& match : *matches_) {
    const double weight = scale * std::sqrt(match.weight);
    r[row] = weight * match.n_world.dot(fk_.position(match.model) - match.p_world);
    if (J != nullptr) {
      PointJacobian J_point;
      fk_.jacobian(match.model, J_point);
      J->row(row) = weight * match.n_world.transpose().lazyProduct(J_point);
    }
    ++row;
  }
}

}  // namespace depthmocap
