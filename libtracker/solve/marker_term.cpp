#include "libtracker/solve/marker_term.h"

#include <cmath>

#include "libtracker/solve/robust_pull.h"

namespace depthmocap {
void MarkerTerm::evaluate(const Pose& q, ResidualRows r, JacobianRows* J) {
  fk_.update(skeleton_, q);
  r.setZero();
  if (J != nullptr) J->setZero();
  for (int i = 0; i < kPartCount; ++i) {
    if (!markers_.seen(i)) continue;
    const BonePoint& point = model_[static_cast<std::size_t>(i)];
    const Eigen::Vector3d e = fk_.position(point) - markers_.position.col(i);
    const RobustPull pull = robustPull(e, sigma_m_, lambda_ * markers_.confidence[i]);
    r.segment<3>(3 * i) = pull.r;
    if (J == nullptr) continue;
    PointJacobian J_point;
    fk_.jacobian(point, J_point);
    J->middleRows<3>(3 * i) = pull.dr_de.lazyProduct(J_point);
    J->row(kResidualRows + i) = pull.along.lazyProduct(J_point);
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
