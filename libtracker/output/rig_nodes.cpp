#include "libtracker/output/rig_nodes.h"

#include "libtracker/body/pose_surface.h"
#include "libtracker/skeleton/forward_kinematics.h"

namespace depthmocap {
namespace {

constexpr std::size_t kEnds = 4;  // hands and toes, the last of a rig's bones; no skin hangs on them

}  // namespace

RigNodes::RigNodes(RigStyle style, const Skeleton& skeleton) : rig_(style, skeleton) {
  const std::vector<MotionBone>& bones = rig_.bones();
  const auto add = [&](const std::string& name, int parent, const Eigen::Vector3d& offset) {
    nodes_.push_back({name, parent, offset});
    return static_cast<int>(nodes_.size()) - 1;
  };
  for (std::size_t b = 0; b < bones.size() - kEnds; ++b) add(bones[b].name, bones[b].parent, bones[b].offset);
  for (int b = 0; b < kBoneCount; ++b) node_of_[static_cast<std::size_t>(b)] = rig_.indexOf(static_cast<Bone>(b));
  for (const TwistBone& limb : kTwistBones) {
    const MotionBone& bone = bones[static_cast<std::size_t>(rig_.indexOf(limb.bone))];
    node_of_[static_cast<std::size_t>(limb.untwisted)] = add(bone.name + "Untwisted", bone.parent, bone.offset);
  }
  for (std::size_t b = bones.size() - kEnds; b < bones.size(); ++b)
    add(bones[b].name, bones[b].parent, bones[b].offset);
  const int head = rig_.indexOf(Bone::Head);
  add(rig_.crownName(), head, bones[static_cast<std::size_t>(head)].tip);
}

Eigen::Quaterniond RigNodes::rotation(int skin_bone, const Pose& q) const {
  if (skin_bone < kBoneCount) {
    const auto bone = static_cast<Bone>(skin_bone);
    return Eigen::Quaterniond(rig_.fromRest(bone, localRotation(bone, q))).normalized();
  }
  const TwistBone& limb = kTwistBones[static_cast<std::size_t>(skin_bone - kBoneCount)];
  const Eigen::Matrix3d R = localRotation(limb.bone, q) *
                            Eigen::AngleAxisd(-q[limb.twist], Eigen::Vector3d::Unit(limb.axis)).toRotationMatrix();
  return Eigen::Quaterniond(rig_.fromRest(limb.bone, R)).normalized();
}

}  // namespace depthmocap
