#include "libtracker/tracker/alignment.h"

#include <cmath>

namespace depthmocap {

MarkerSet modelMarkers(const Actor& actor, const Pose& q, ForwardKinematics& fk) {
  fk.update(actor.skeleton, q);
  MarkerSet markers;
  for (int i = 0; i < kPartCount; ++i)
    markers.position.col(i) = fk.position(actor.markers[static_cast<std::size_t>(i)]);
  markers.confidence.setOnes();
  return markers;
}

Pose placedAt(const Actor& actor, Pose q, const MarkerSet& seen, ForwardKinematics& fk) {
  q.head<3>().setZero();
  q[kRootRy] = 0;
  const MarkerSet model = modelMarkers(actor, q, fk);
  const Eigen::Matrix<double, kPartCount, 1>& w = seen.confidence;
  const double total = w.sum();
  if (total <= 0) return q;
  const Eigen::Vector3d seen_mean = seen.position * w / total;
  const Eigen::Vector3d model_mean = model.position * w / total;
  double along = 0;
  double across = 0;
  for (int i = 0; i < kPartCount; ++i) {
    const Eigen::Vector3d p = seen.position.col(i) - seen_mean;
    const Eigen::Vector3d m = model.position.col(i) - model_mean;
    along += w[i] * (p.x() * m.x() + p.z() * m.z());
    across += w[i] * (p.x() * m.z() - p.z() * m.x());
  }
  q[kRootRy] = std::atan2(across, along);
  const Eigen::Matrix3d heading = Eigen::AngleAxisd(q[kRootRy], Eigen::Vector3d::UnitY()).toRotationMatrix();
  q.head<3>() = seen_mean - heading * model_mean;
  return q;
}

MarkerSet rotated(const Eigen::Matrix3d& R_to_from, const MarkerSet& markers) {
  MarkerSet result = markers;
  result.position = R_to_from * markers.position;
  return result;
}

}  // namespace depthmocap
