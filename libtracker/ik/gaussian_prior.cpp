#include "libtracker/ik/gaussian_prior.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "libtracker/core/check.h"

namespace depthmocap {
namespace {

// -2 log of what stands before the exponential of weight N(x), up to a constant.
double logNormaliser(const PoseGaussian& g) {
  const auto others = static_cast<double>(kShapeDofCount - g.deviation.size());
  return 2.0 * (g.deviation.array().log().sum() + others * std::log(g.residual_rad) - std::log(g.weight));
}

}  // namespace

GaussianPrior::GaussianPrior(const std::vector<PoseGaussian>& components) {
  DMC_CHECK(!components.empty());
  double least = std::numeric_limits<double>::max();
  for (const PoseGaussian& g : components) least = std::min(least, logNormaliser(g));
  for (const PoseGaussian& g : components) {
    const Eigen::VectorXd excess = g.deviation.cwiseInverse().array() - 1.0 / g.residual_rad;
    const ShapeMatrix whitening =
        ShapeMatrix::Identity() / g.residual_rad + g.basis * excess.asDiagonal() * g.basis.transpose();
    components_.push_back({g.mean, whitening, std::sqrt(logNormaliser(g) - least)});
  }
}

void GaussianPrior::evaluate(const PoseShape& shape, Eigen::Ref<Eigen::VectorXd> r, Eigen::MatrixXd* J) const {
  double least = std::numeric_limits<double>::max();
  const Component* nearest = nullptr;
  for (const Component& component : components_) {
    const PoseShape whitened = component.whitening * (shape - component.mean);
    const double energy = whitened.squaredNorm() + component.constant * component.constant;
    if (nearest != nullptr && !(energy < least)) continue;
    least = energy;
    nearest = &component;
    r.head<kShapeDofCount>() = whitened;
  }
  r[kShapeDofCount] = nearest->constant;
  if (J == nullptr) return;
  J->setZero(rows(), kShapeDofCount);
  J->topRows<kShapeDofCount>() = nearest->whitening;
}

}  // namespace depthmocap
