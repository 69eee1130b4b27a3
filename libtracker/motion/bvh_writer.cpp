#include "libtracker/motion/bvh_writer.h"

#include <array>
#include <string_view>

#include "libtracker/skeleton/forward_kinematics.h"

namespace depthmocap {
namespace {

constexpr std::array<std::string_view, kBoneCount> kBvhNames = {
    "Hips", "Spine", "RightShoulder", "LeftShoulder", "RightArm", "LeftArm", "RightForeArm", "LeftForeArm",
    "Neck", "Head",  "RightUpLeg",    "LeftUpLeg",    "RightLeg", "LeftLeg", "RightFoot",    "LeftFoot"};
// End Sites, as shares of the bone before: finger tips, tips of the toes. The head's lies at the crown.
constexpr double kHandPerLowerArm = 0.7;
constexpr double kToesPerFoot = 0.4;

// An End Site cannot move; where bones do, the crown is a bone of its own.
std::vector<MotionBone> writtenBones(const Skeleton& skeleton, bool moving_bones) {
  std::vector<MotionBone> bones = bvhBones(skeleton);
  if (!moving_bones) return bones;
  MotionBone& head = bones[static_cast<std::size_t>(Bone::Head)];
  MotionBone crown;
  crown.name = "HeadTop_End";
  crown.parent = static_cast<int>(Bone::Head);
  crown.offset = head.tip;
  head.has_tip = false;
  bones.push_back(crown);
  return bones;
}

}  // namespace

std::vector<MotionBone> bvhBones(const Skeleton& s) {
  std::vector<MotionBone> bones;
  for (std::size_t b = 0; b < kBoneCount; ++b) {
    MotionBone bone;
    bone.name = kBvhNames[b];
    bone.parent = kBoneParents[b];
    bone.offset = s.offset[b];
    bones.push_back(bone);
  }
  MotionBone& head = bones[static_cast<std::size_t>(Bone::Head)];
  head.tip = 2.0 * s.head_center;
  head.has_tip = true;
  const auto add = [&](std::string_view name, Bone parent, const Eigen::Vector3d& offset, const Eigen::Vector3d& tip) {
    MotionBone bone;
    bone.name = name;
    bone.parent = static_cast<int>(parent);
    bone.offset = offset;
    bone.tip = tip;
    bone.has_tip = true;
    bones.push_back(bone);
  };
  const Eigen::Vector3d toes(0, 0, kToesPerFoot * s.lengths.foot);
  add("RightHand", Bone::RightRadius, s.right_wrist, kHandPerLowerArm * s.right_wrist);
  add("LeftHand", Bone::LeftRadius, s.left_wrist, kHandPerLowerArm * s.left_wrist);
  add("RightToeBase", Bone::RightFoot, s.right_toe, toes);
  add("LeftToeBase", Bone::LeftFoot, s.left_toe, toes);
  return bones;
}

BvhWriter::BvhWriter(const std::filesystem::path& path, const Skeleton& skeleton, double fps, double scale,
                     bool moving_bones)
    : rows_(path, writtenBones(skeleton, moving_bones), fps, scale, moving_bones) {
  for (const MotionBone& bone : writtenBones(skeleton, moving_bones)) positions_.push_back(bone.offset);
  rotations_.assign(positions_.size(), Eigen::Quaterniond::Identity());
}

void BvhWriter::write(const Pose& q) {
  writeRow(q);
}

void BvhWriter::write(const Pose& q, const Skeleton& skeleton) {
  const std::vector<MotionBone> bones = writtenBones(skeleton, true);
  for (std::size_t b = 0; b < bones.size(); ++b) positions_[b] = bones[b].offset;
  writeRow(q);
}

void BvhWriter::writeRow(const Pose& q) {
  positions_[0] = q.head<3>();
  for (std::size_t b = 0; b < kBoneCount; ++b) {
    rotations_[b] = Eigen::Quaterniond(localRotation(static_cast<Bone>(b), q));
  }
  rows_.write(positions_, rotations_);
}

}  // namespace depthmocap
