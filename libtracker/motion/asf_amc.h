#pragma once
#include <filesystem>
#include <vector>

#include "libtracker/motion/source_motion.h"

namespace depthmocap {

// The order in which values of a file turn and move a bone. Bones are rigid: Length, a stretch, is not used.
enum class MotionChannel { Tx, Ty, Tz, Rx, Ry, Rz, Length };

// An ASF skeleton (Acclaim 1.10): the bones in metres (value / :length * 0.0254, the :units of the file), and how the
// AMC turns them. Angles in the unit that :units names.
struct AsfSkeleton {
  struct Motion {
    std::vector<MotionChannel> channels;                        // of the AMC line, in its order; empty: a rigid bone
    Eigen::Matrix3d axis = Eigen::Matrix3d::Identity();         // R_world_channels in the rest pose
    Eigen::Matrix3d orientation = Eigen::Matrix3d::Identity();  // the root's preset orientation
    Eigen::Vector3d position = Eigen::Vector3d::Zero();         // the root's preset position [m]
  };
  std::vector<MotionBone> bones;
  std::vector<Motion> motions;  // one per bone
  double metres_per_unit = 0.0254 / 0.45;
  bool degrees = true;
};

// Reads an ASF file. Unknown keywords and sections are skipped; limits are not needed and not read. Error with
// file:line.
AsfSkeleton readAsf(const std::filesystem::path& path);

// Reads an AMC file for a skeleton. The format holds no frame rate: fps [1/s] is the caller's. A last frame
// that is cut short is left out, and a bone that no frame has is rigid, with a line in `warnings`. Error with
// file:line.
SourceMotion readAmc(const std::filesystem::path& path, const AsfSkeleton& skeleton, double fps);

// Writes a motion whose bones are in metres as ASF and AMC (:length 0.45, degrees, XYZ axes along the world's).
// A bone begins where its parent ends in this format, so a fixed bone of the offset's length goes before every bone.
void writeAsfAmc(const SourceMotion& motion, const std::filesystem::path& asf, const std::filesystem::path& amc);

}  // namespace depthmocap
