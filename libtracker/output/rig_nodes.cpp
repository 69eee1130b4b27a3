#include "libtracker/output/rig_nodes.h"

#include <Eigen/Geometry>

#include "libtracker/body/pose_surface.h"
#include "libtracker/motion/rig.h"
#include "libtracker/skeleton/forward_kinematics.h"

namespace depthmocap {

std::vector<RigNode> rigNodes(const Skeleton& skeleton) {
  const Rig rig(RigStyle::MotionBuilder, skeleton);
  const std::vector<MotionBone>& bones = rig.bones();
  std::vector<RigNode> nodes;
  const auto add = [&](const std::string& name, int parent, const Eigen::Vector3d& offset) {
    nodes.push_back({name, parent, offset});
  };
  for (std::size_t b = 0; b < kBoneCount; ++b) add(bones[b].name, bones[b].parent, bones[b].offset);
  for (const TwistBone& limb : kTwistBones) {
    const MotionBone& bone = bones[static_cast<std::size_t>(limb.bone)];
    add(bone.name + "Untwisted", bone.parent, bone.offset);
  }
  for (std::size_t b = kBoneCount; b < bones.size(); ++b) add(bones[b].name, bones[b].parent, bones[b].offset);
  const auto head = static_cast<std::size_t>(Bone::Head);
  add("HeadTop_End", static_cast<int>(head), bones[head].tip);
  return nodes;
}

Eigen::Matrix3d rigNodeRotation(int node, const Pose& q) {
  if (node < kBoneCount) return localRotation(static_cast<Bone>(node), q);
  if (node >= kSkinBoneCount) return Eigen::Matrix3d::Identity();
  const TwistBone& limb = kTwistBones[static_cast<std::size_t>(node - kBoneCount)];
  return localRotation(limb.bone, q) *
         Eigen::AngleAxisd(-q[limb.twist], Eigen::Vector3d::Unit(limb.axis)).toRotationMatrix();
}

}  // namespace depthmocap
