#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>
#include <string_view>
#include <vector>

namespace depthmocap {

// One bone of a motion file. With all rotations at identity (the rest pose) every bone frame is parallel to the world.
struct MotionBone {
  std::string name;
  int parent = -1;                                   // index; parents stand before children, the root is bone 0
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();  // of the bone's origin in the parent's frame, file units
  Eigen::Vector3d tip = Eigen::Vector3d::Zero();     // end of the bone in its own frame (ASF: the bone; BVH: End Site)
  bool has_tip = false;
};

// The bones of one frame in their parents' frames.
struct MotionFrame {
  std::vector<Eigen::Vector3d> position;     // of each bone's origin; the bone's offset where the file does not move it
  std::vector<Eigen::Quaterniond> rotation;  // of each bone
};

// A motion as its file gives it: any skeleton, any unit, any axis up.
struct SourceMotion {
  std::vector<MotionBone> bones;
  double fps = 30.0;  // [1/s] (> 0)
  std::vector<MotionFrame> frames;
  // What the reader had to guess or leave out, a line each, without the file's name.
  std::vector<std::string> warnings = {};

  // Index of the bone of this name, -1 if there is none.
  [[nodiscard]] int find(std::string_view name) const;
};

// Every bone of one frame in the world.
struct GlobalFrame {
  std::vector<Eigen::Vector3d> position;
  std::vector<Eigen::Matrix3d> rotation;

  [[nodiscard]] Eigen::Vector3d point(int bone, const Eigen::Vector3d& p_bone) const {
    return rotation[static_cast<std::size_t>(bone)] * p_bone + position[static_cast<std::size_t>(bone)];
  }
};
void globalFrame(const std::vector<MotionBone>& bones, const MotionFrame& frame, GlobalFrame& global);
// The rest pose: identity rotations, bones at their offsets.
GlobalFrame restFrame(const std::vector<MotionBone>& bones);

// The bones with the mean of their positions as offsets (the root's stays): files may move joints that a skeleton
// holds.
std::vector<MotionBone> meanBones(const SourceMotion& motion);

// The motion at another rate [1/s] (> 0): rotations by slerp, positions linearly. Keeps the first frame's time.
SourceMotion resampled(const SourceMotion& motion, double fps);

}  // namespace depthmocap
