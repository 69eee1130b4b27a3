#include "libtracker/output/vmc_bones.h"

#include "libtracker/output/unity_axes.h"
#include "libtracker/skeleton/forward_kinematics.h"

namespace depthmocap {
std::array<VmcBone, kVmcBoneCount> vmcBones(const Skeleton& s, const Pose& q, const Eigen::Vector3d& origin) {
  std::array<VmcBone, kVmcBoneCount> bones;
  std::size_t next = 0;
  const auto add = [&](const Eigen::Vector3d& offset, const Eigen::Quaterniond& rotation) {
    bones[next++] = {inUnity(offset), inUnity(rotation)};
  };
  const auto bone = [&](Bone b) {
    const Eigen::Vector3d offset = b == Bone::Root ? Eigen::Vector3d(q.head<3>() - origin)
                                                   : Eigen::Vector3d(s.offset[static_cast<std::size_t>(b)]);
    add(offset, Eigen::Quaterniond(localRotation(b, q)));
  };
  const auto end = [&](const Eigen::Vector3d& offset) { add(offset, Eigen::Quaterniond::Identity()); };
  for (const Bone b : {Bone::Root, Bone::UpperBack, Bone::Neck, Bone::Head}) bone(b);
  for (const Bone b : {Bone::LeftClavicle, Bone::LeftHumerus, Bone::LeftRadius}) bone(b);
  end(s.left_wrist);
  for (const Bone b : {Bone::RightClavicle, Bone::RightHumerus, Bone::RightRadius}) bone(b);
  end(s.right_wrist);
  for (const Bone b : {Bone::LeftFemur, Bone::LeftTibia, Bone::LeftFoot}) bone(b);
  end(s.left_toe);
  for (const Bone b : {Bone::RightFemur, Bone::RightTibia, Bone::RightFoot}) bone(b);
  end(s.right_toe);
  return bones;
}

}  // namespace depthmocap
