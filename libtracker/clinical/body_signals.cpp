#include "libtracker/clinical/body_signals.h"

#include <algorithm>

namespace depthmocap {

BodySignals bodySignals(const ForwardKinematics& fk, const Skeleton& skeleton) {
  const double ankle_m = ankleHeight(skeleton.lengths);
  const double toe_m = ankle_m + skeleton.left_toe.y();  // above the floor where the foot stands flat
  const Eigen::Vector3d pelvis = fk.origin(Bone::Root);
  Eigen::Vector3d forward = fk.R_world_bone(Bone::Root).col(2);
  forward.y() = 0;
  if (forward.norm() > 1e-6) forward.normalize();  // else face down or up: nothing is ahead
  const auto ahead = [&](Bone foot) { return forward.dot(fk.origin(foot) - pelvis); };
  const auto sole = [&](Bone foot, const Eigen::Vector3d& toe) {
    return std::min(fk.origin(foot).y() - ankle_m, fk.position({foot, toe}).y() - toe_m);
  };
  return {pelvis.y(), sole(Bone::LeftFoot, skeleton.left_toe), sole(Bone::RightFoot, skeleton.right_toe),
          ahead(Bone::LeftFoot), ahead(Bone::RightFoot)};
}

}  // namespace depthmocap
