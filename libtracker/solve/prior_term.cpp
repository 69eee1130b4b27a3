#include "libtracker/solve/prior_term.h"

#include <cmath>

namespace depthmocap {

PriorTerm::PriorTerm(const LocalPrior* prior, double lambda) {
  off_subspace_.setZero();
  mean_.setZero();
  if (prior == nullptr) return;
  for (int row = 0; row < kRows; ++row) {
    const int dof = kShapeDofs[static_cast<std::size_t>(row)];
    mean_[row] = prior->mean[dof];
    for (int column = 0; column < kRows; ++column) {
      const int other = kShapeDofs[static_cast<std::size_t>(column)];
      double inside = 0;
      for (int b = 0; b < prior->dims; ++b) inside += prior->basis(dof, b) * prior->basis(other, b);
      off_subspace_(row, column) = std::sqrt(lambda) * ((row == column ? 1.0 : 0.0) - inside);
    }
  }
}

void PriorTerm::evaluate(const Pose& q, ResidualRows r, JacobianRows* J) const {
  ShapeVector offset;
  for (int i = 0; i < kRows; ++i) offset[i] = q[kShapeDofs[static_cast<std::size_t>(i)]] - mean_[i];
  r = off_subspace_.lazyProduct(offset);
  if (J == nullptr) return;
  J->setZero();
  for (int i = 0; i < kRows; ++i) J->col(kShapeDofs[static_cast<std::size_t>(i)]) = off_subspace_.col(i);
}

}  // namespace depthmocap
