#pragma once
#include <Eigen/Geometry>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "libtracker/motion/source_motion.h"
#include "libtracker/skeleton/skeleton.h"

namespace depthmocap {

// Skeletons that other programs know by their bones' names.
enum class RigStyle { MotionBuilder, Mixamo, Rigify, Unreal, Vrm };
inline constexpr std::array<std::string_view, 5> kRigNames = {"motionbuilder", "mixamo", "rigify", "unreal", "vrm"};
// Error for an unknown name.
RigStyle rigStyle(std::string_view name);

// Our body as such a skeleton: our 16 bones, hands and toes under the names that the program expects, the spine's bones
// that it expects besides (they do not turn), and the program's rest pose: T, or arms lowered as the mannequin of
// Unreal and the human of Rigify have them. In the rest pose every bone's frame is parallel to the world. Hands and
// toes do not move by themselves.
class Rig {
 public:
  Rig(RigStyle style, const Skeleton& skeleton);

  // Parents before children, in the rest pose.
  [[nodiscard]] const std::vector<MotionBone>& bones() const { return bones_; }
  // The name of the crown, where it is a bone: at the tip of the head.
  [[nodiscard]] const std::string& crownName() const { return crown_name_; }
  [[nodiscard]] int indexOf(Bone bone) const { return index_[static_cast<std::size_t>(bone)]; }
  // The rest pose on our body.
  [[nodiscard]] const Pose& rest() const { return rest_; }
  // How many bones from the first one on are moved: 1, or 2 where the hips hang on a bone that stands on the floor.
  [[nodiscard]] int movingBones() const { return indexOf(Bone::Root) + 1; }

  // Positions of the moving bones in their parents for a pose: what stands on the floor has no height.
  [[nodiscard]] std::vector<Eigen::Vector3d> positions(const Pose& q) const;
  // A rotation of `bone` in its parent, counted from the rest pose in place of the T-pose.
  [[nodiscard]] Eigen::Matrix3d fromRest(Bone bone, const Eigen::Matrix3d& R_parent_bone) const;
  // Rotations of all bones in their parents for a pose.
  [[nodiscard]] std::vector<Eigen::Quaterniond> rotations(const Pose& q) const;

 private:
  int add(const std::string& name, int parent, const Eigen::Vector3d& offset);

  std::vector<MotionBone> bones_;
  std::string crown_name_;
  std::array<int, kBoneCount> index_{};
  std::array<Eigen::Matrix3d, kBoneCount> R_rest_;  // in the world
  Pose rest_ = Pose::Zero();
};

}  // namespace depthmocap
