#include "libtracker/solve/prior_term.h"

#include <cmath>

namespace depthmocap {

PriorTerm::PriorTerm(const LocalPrior* prior, double lambda) {
  off_model_.setZero();
  mean_.setZero();
  if (prior == nullptr) return;
  off_model_.diagonal().setOnes();
  for (int row = 0; row < kRows; ++row) mean_[row] = prior->mean[kShapeDofs[static_cast<std::size_t>(row)]];
  for (int b = 0; b < prior->dims; ++b) {
    ShapeVector direction;
    for (int i = 0; i < kRows; ++i) direction[i] = prior->basis(kShapeDofs[static_cast<std::size_t>(i)], b);
    const double r = prior->residual_rad;
    const double taken = r > 0 ? 1.0 - r / std::hypot(prior->deviation[b], r) : 1.0;
    off_model_ -= taken * direction * direction.transpose();
  }
  off_model_ *= std::sqrt(lambda);
}

void PriorTerm::evaluate(const Pose& q, ResidualRows r, JacobianRows* J) const {
  ShapeVector offset;
  for (int i = 0; i < kRows; ++i) offset[i] = q[kShapeDofs[static_cast<std::size_t>(i)]] - mean_[i];
  r = off_model_.lazyProduct(offset);
  if (J == nullptr) return;
  J->setZero();
  for (int i = 0; i < kRows; ++i) J->col(kShapeDofs[static_cast<std::size_t>(i)]) = off_model_.col(i);
}

}  // namespace depthmocap
