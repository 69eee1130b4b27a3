#include "libtracker/solve/marker_term.h"

#include <algorithm>
#include <cmath>

namespace depthmocap {
namespace {

// The Lorentzian rho = log(1 + x / (2 sigma^2)) of x = |e|^2, as the scale of a residual: s(x) = sqrt(rho / x) and
// ds/dx, finite at 0; and the curvature that s e lacks along e, see MarkerTerm.
struct RobustScale {
  double value;
  double slope;
  double missing_curvature;
};

RobustScale robustScale(double x, double sigma_m) {
  const double per_x = 1.0 / (2.0 * sigma_m * sigma_m);
  const double u = x * per_x;
  // g(u) = log(1 + u) / u and its derivative; the series near 0, where the quotients cancel.
  const bool small = u < 1e-4;
  const double g = small ? 1.0 - u / 2.0 + u * u / 3.0 : std::log1p(u) / u;
  const double dg = small ? -0.5 + 2.0 * u / 3.0 - 0.75 * u * u : (u / (1.0 + u) - std::log1p(u)) / (u * u);
  const double s = std::sqrt(per_x * g);
  const double drho = per_x / (1.0 + u);
  const double along = (drho * drho) / (s * s);
  return {s, per_x * per_x * dg / (2.0 * s), std::max(0.0, drho - along)};
}

}  // namespace

void MarkerTerm::evaluate(const Pose& q, ResidualRows r, JacobianRows* J) {
  fk_.update(skeleton_, q);
  r.setZero();
  if (J != nullptr) J->setZero();
  for (int i = 0; i < kPartCount; ++i) {
    if (!markers_.seen(i)) continue;
    const BonePoint& point = model_[static_cast<std::size_t>(i)];
    const Eigen::Vector3d e = fk_.position(point) - markers_.position.col(i);
    const RobustScale s = robustScale(e.squaredNorm(), sigma_m_);
    const double weight = std::sqrt(lambda_ * markers_.confidence[i]);
    r.segment<3>(3 * i) = weight * s.value * e;
    if (J == nullptr) continue;
    PointJacobian J_point;
    fk_.jacobian(point, J_point);
    const Eigen::Matrix3d dr_de = weight * (s.value * Eigen::Matrix3d::Identity() + 2.0 * s.slope * e * e.transpose());
    J->middleRows<3>(3 * i) = dr_de.lazyProduct(J_point);
    const Eigen::RowVector3d along = weight * std::sqrt(s.missing_curvature) * e.normalized().transpose();
    J->row(kResidualRows + i) = along.lazyProduct(J_point);
  }
}

double MarkerTerm::rms(const Pose& q) {
  fk_.update(skeleton_, q);
  double sum = 0;
  for (int i = 0; i < kPartCount; ++i) {
    if (!markers_.seen(i)) continue;
    const Eigen::Vector3d e = fk_.position(model_[static_cast<std::size_t>(i)]) - markers_.position.col(i);
    sum += markers_.confidence[i] * e.squaredNorm();
  }
  const double total = markers_.confidence.cwiseMax(0.0).sum();
  return total > 0 ? std::sqrt(sum / total) : 0.0;
}

}  // namespace depthmocap
