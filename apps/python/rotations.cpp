#include "apps/python/rotations.h"

#include <Eigen/Geometry>

#include "libtracker/skeleton/forward_kinematics.h"

namespace depthmocap {

Quaternions boneRotations(const Pose& q) {
  Quaternions all;
  for (int bone = 0; bone < kBoneCount; ++bone) {
    const Eigen::Quaterniond r(localRotation(static_cast<Bone>(bone), q));
    all.col(bone) << r.w(), r.x(), r.y(), r.z();
  }
  return all;
}

}  // namespace depthmocap
