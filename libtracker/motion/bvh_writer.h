#pragma once
#include <filesystem>
#include <vector>

#include "libtracker/motion/bvh.h"
#include "libtracker/motion/rig.h"

namespace depthmocap {

// Writes poses of the 36-DoF body as BVH with the joint names and the rest pose of a rig, one row per frame as they
// come (see BvhRows). Offsets are the rest pose, y up, facing +z; scale 1 writes metres, 100 centimetres.
class BvhWriter {
 public:
  // `moving_bones`: every bone has position channels, and the crown is a bone (HeadTop_End), for a body whose size is
  // still being found.
  BvhWriter(const std::filesystem::path& path, const Skeleton& skeleton, double fps, double scale = 1.0,
            bool moving_bones = false, RigStyle style = RigStyle::MotionBuilder);
  void write(const Pose& q);
  // A frame with bones of other lengths; only where bones move.
  void write(const Pose& q, const Skeleton& skeleton);
  // Completes the file under its name; without it no file is left.
  void finish() { rows_.finish(); }

 private:
  void writeRow(const Pose& q);

  RigStyle style_;
  Rig rig_;
  BvhRows rows_;
  std::vector<Eigen::Vector3d> positions_;
};

}  // namespace depthmocap
