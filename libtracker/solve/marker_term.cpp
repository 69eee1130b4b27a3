#include "libtracker/solve/marker_term.h"

#include <cmath>

#include "libtracker/solve/robust_pull.h"

namespace depthmocap {

double MarkerTerm::energy(const ForwardKinematics& fk) const {
  double sum = 0;
  for (int i = 0; i < kPartCount; ++i) {
    if (!markers_.seen(i)) continue;
    const Eigen::Vector3d e = fk.position(model_[static_cast<std::size_t>(i)]) - markers_.position.col(i);
    sum += robustPull(e.squaredNorm(), sigma_m_, lambda_ * markers_.confidence[i]).energy;
  }
  return sum;
}

void MarkerTerm::addTo(const ForwardKinematics& fk, TwistEquations& equations) const {
  for (int i = 0; i < kPartCount; ++i) {
    if (!markers_.seen(i)) continue;
    const BonePoint& point = model_[static_cast<std::size_t>(i)];
    const Eigen::Vector3d p = fk.position(point);
    const Eigen::Vector3d e = p - markers_.position.col(i);
    const RobustPull pull = robustPull(e.squaredNorm(), sigma_m_, lambda_ * markers_.confidence[i]);
    equations.addPoint(point.bone, p, e, pull.k);
  }
}

double MarkerTerm::rms(const ForwardKinematics& fk) const {
  double sum = 0;
  for (int i = 0; i < kPartCount; ++i) {
    if (!markers_.seen(i)) continue;
    const Eigen::Vector3d e = fk.position(model_[static_cast<std::size_t>(i)]) - markers_.position.col(i);
    sum += markers_.confidence[i] * e.squaredNorm();
  }
  const double total = markers_.confidence.cwiseMax(0.0).sum();
  return total > 0 ? std::sqrt(sum / total) : 0.0;
}

}  // namespace depthmocap
