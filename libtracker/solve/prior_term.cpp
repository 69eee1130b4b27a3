#include "libtracker/solve/prior_term.h"

#include <cmath>

namespace depthmocap {

PriorTerm::PriorTerm(const LocalPrior* prior, double lambda, double freedom) {
  weight_.setZero();
  mean_.setZero();
  if (prior == nullptr) return;
  Eigen::Matrix<double, kShapeDofCount, kMaxPriorDims> taken;
  for (int i = 0; i < kShapeDofCount; ++i) {
    const int dof = kShapeDofs[static_cast<std::size_t>(i)];
    mean_[i] = prior->mean[dof];
    taken.row(i) = prior->basis.row(dof);
  }
  for (int b = 0; b < prior->dims; ++b) {
    // (1 - s)^2 = 1 - (1 - kept^2), where s is what the direction takes and kept what is left of a distance along it.
    const double r = prior->residual_rad;
    const double kept = r > 0 ? r / std::hypot(prior->deviation[b], r) : 0.0;
    taken.col(b) *= std::sqrt(lambda * (1.0 - kept * kept));
  }
  weight_.noalias() -= taken.leftCols(prior->dims).lazyProduct(taken.leftCols(prior->dims).transpose());
  weight_.diagonal().array() += lambda;
  unit_ = lambda * prior->residual_rad * prior->residual_rad;
  freedom_ = unit_ > 0 ? freedom : 0;
}

double PriorTerm::eased(double quadratic) const {
  if (freedom_ == 0) return quadratic;
  return unit_ * (freedom_ + kShapeDofCount) * std::log1p(quadratic / (unit_ * freedom_));
}

double PriorTerm::easing(double quadratic) const {
  return freedom_ == 0 ? 1.0 : (freedom_ + kShapeDofCount) / (freedom_ + quadratic / unit_);
}

PriorTerm::ShapeVector PriorTerm::offset(const Pose& q) const {
  ShapeVector offset;
  for (int i = 0; i < kShapeDofCount; ++i) offset[i] = q[kShapeDofs[static_cast<std::size_t>(i)]] - mean_[i];
  return offset;
}

double PriorTerm::energy(const Pose& q) const {
  const ShapeVector d = offset(q);
  return eased(d.dot(weight_.lazyProduct(d)));
}

void PriorTerm::addTo(const Pose& q, NormalEquations& equations) const {
  const ShapeVector d = offset(q);
  const ShapeVector pull = weight_.lazyProduct(d);
  const double share = easing(d.dot(pull));
  for (int i = 0; i < kShapeDofCount; ++i) {
    const int row = kShapeDofs[static_cast<std::size_t>(i)];
    equations.g[row] += share * pull[i];
    for (int j = 0; j <= i; ++j) equations.A(row, kShapeDofs[static_cast<std::size_t>(j)]) += share * weight_(i, j);
  }
}

}  // namespace depthmocap
