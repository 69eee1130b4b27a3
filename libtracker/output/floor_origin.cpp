#include "libtracker/output/floor_origin.h"

#include <algorithm>

#include "libtracker/skeleton/forward_kinematics.h"

namespace depthmocap {
namespace {

constexpr double kFall_s = 0.3;  // time constants of the floor's height
constexpr double kRise_s = 4.0;

}  // namespace

const Eigen::Vector3d& FloorOrigin::update(const Skeleton& skeleton, const Pose& q, double time_s) {
  ForwardKinematics fk;
  fk.update(skeleton, q);
  const double sole =
      std::min(fk.origin(Bone::LeftFoot).y(), fk.origin(Bone::RightFoot).y()) - ankleHeight(skeleton.lengths);
  if (!started_) origin_ = {q[kRootTx], sole, q[kRootTz]};
  const double dt_s = started_ ? std::max(0.0, time_s - time_s_) : 0.0;
  started_ = true;
  time_s_ = time_s;
  const double time_constant_s = sole < origin_.y() ? kFall_s : kRise_s;
  origin_.y() += (sole - origin_.y()) * dt_s / (dt_s + time_constant_s);
  return origin_;
}

}  // namespace depthmocap
