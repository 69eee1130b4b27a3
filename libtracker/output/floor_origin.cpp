#include "libtracker/output/floor_origin.h"

#include <algorithm>

#include "libtracker/skeleton/forward_kinematics.h"

namespace depthmocap {

double lowerSole(const Skeleton& skeleton, const Pose& q) {
  ForwardKinematics fk;
  fk.update(skeleton, q);
  return std::min(fk.origin(Bone::LeftFoot).y(), fk.origin(Bone::RightFoot).y()) - ankleHeight(skeleton.lengths);
}

const Eigen::Vector3d& FloorOrigin::update(const Skeleton& skeleton, const Pose& q, double time_s) {
  if (!started_) origin_ = {q[kRootTx], 0, q[kRootTz]};
  started_ = true;
  origin_.y() = height_.follow(lowerSole(skeleton, q), time_s);
  return origin_;
}

}  // namespace depthmocap
