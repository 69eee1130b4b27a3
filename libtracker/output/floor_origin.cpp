#include "libtracker/output/floor_origin.h"

#include <algorithm>

#include "libtracker/skeleton/forward_kinematics.h"

namespace depthmocap {

const Eigen::Vector3d& FloorOrigin::update(const Skeleton& skeleton, const Pose& q, double time_s) {
  ForwardKinematics fk;
  fk.update(skeleton, q);
  const double ankle_y = std::min(fk.origin(Bone::LeftFoot).y(), fk.origin(Bone::RightFoot).y());
  if (!started_) origin_ = {q[kRootTx], 0, q[kRootTz]};
  started_ = true;
  origin_.y() = height_.follow(ankle_y - ankleHeight(skeleton.lengths), time_s);
  return origin_;
}

}  // namespace depthmocap
