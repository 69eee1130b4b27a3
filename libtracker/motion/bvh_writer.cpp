#include "libtracker/motion/bvh_writer.h"

#include <algorithm>

namespace depthmocap {
namespace {

// An End Site cannot move; where bones do, the crown is a bone of its own.
std::vector<MotionBone> writtenBones(const Rig& rig, bool moving_bones) {
  std::vector<MotionBone> bones = rig.bones();
  if (!moving_bones) return bones;
  const int head_index = rig.indexOf(Bone::Head);
  MotionBone& head = bones[static_cast<std::size_t>(head_index)];
  MotionBone crown;
  crown.name = rig.crownName();
  crown.parent = head_index;
  crown.offset = head.tip;
  head.has_tip = false;
  bones.push_back(crown);
  return bones;
}

std::size_t movingBones(const Rig& rig, bool all) {
  return all ? writtenBones(rig, true).size() : static_cast<std::size_t>(rig.movingBones());
}

}  // namespace

BvhWriter::BvhWriter(const std::filesystem::path& path, const Skeleton& skeleton, double fps, double scale,
                     bool moving_bones, RigStyle style)
    : style_(style),
      rig_(style, skeleton),
      rows_(path, writtenBones(rig_, moving_bones), fps, scale, movingBones(rig_, moving_bones)) {
  for (const MotionBone& bone : writtenBones(rig_, moving_bones)) positions_.push_back(bone.offset);
}

void BvhWriter::write(const Pose& q) {
  writeRow(q);
}

void BvhWriter::write(const Pose& q, const Skeleton& skeleton) {
  const std::vector<MotionBone> bones = writtenBones(Rig(style_, skeleton), true);
  for (std::size_t b = 0; b < bones.size(); ++b) positions_[b] = bones[b].offset;
  writeRow(q);
}

void BvhWriter::writeRow(const Pose& q) {
  std::ranges::copy(rig_.positions(q), positions_.begin());
  std::vector<Eigen::Quaterniond> rotations = rig_.rotations(q);
  rotations.resize(positions_.size(), Eigen::Quaterniond::Identity());
  rows_.write(positions_, rotations);
}

}  // namespace depthmocap
