#pragma once
#include <filesystem>
#include <vector>

#include "libtracker/motion/bvh.h"
#include "libtracker/skeleton/skeleton.h"

namespace depthmocap {

// Writes poses of the 36-DoF body as BVH with the joint names of MotionBuilder and Mixamo (Hips, Spine, LeftArm, ...),
// one row per frame as they come (see BvhRows). Offsets are the T-pose, y up, facing +z; scale 1 writes metres, 100
// centimetres. Hands and toes do not move by themselves.
class BvhWriter {
 public:
  // `moving_bones`: every bone has position channels, and the crown is the bone HeadTop_End, for a body whose size is
  // still being found.
  BvhWriter(const std::filesystem::path& path, const Skeleton& skeleton, double fps, double scale = 1.0,
            bool moving_bones = false);
  void write(const Pose& q);
  // A frame with bones of other lengths; only where bones move.
  void write(const Pose& q, const Skeleton& skeleton);
  // Completes the file under its name; without it no file is left.
  void finish() { rows_.finish(); }

 private:
  void writeRow(const Pose& q);

  BvhRows rows_;
  std::vector<Eigen::Vector3d> positions_;
  std::vector<Eigen::Quaterniond> rotations_;
};

// The bones that BvhWriter writes: those of the skeleton in the order of Bone, then hands and toes.
std::vector<MotionBone> bvhBones(const Skeleton& skeleton);

}  // namespace depthmocap
