#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "libtracker/core/atomic_file.h"
#include "libtracker/motion/source_motion.h"

namespace depthmocap {

// Reads a BVH file in its own unit and with its own axis up. Rotations multiply in the order in which the channels are
// listed (Zrotation Xrotation Yrotation: R = Rz Rx Ry, degrees); position channels replace the OFFSET, scale channels
// are passed over. An End Site is its parent's tip. Of several ROOTs the one with the most joints is read. What other
// programs write otherwise (decimal commas, rows over several lines, a wrong number of frames, a last row cut short, a
// frame time that is none) is read with a line in `warnings`; fps_if_unsaid [1/s] (> 0) where the file gives no rate.
// Error with file:line.
SourceMotion readBvh(const std::filesystem::path& path, double fps_if_unsaid = 30.0);

// Writes BVH row by row; the file appears at finish(), which knows how many there are, and without it nothing stays.
// Rows wait in memory, half a kilobyte each. Channels: root Xposition Yposition Zposition Zrotation Yrotation
// Xrotation, every other bone Zrotation Yrotation Xrotation, with positions before them for the first `moving_bones`,
// which move in their parents; the Euler angles [deg] continue those of the row before. Lengths are multiplied by
// `scale`. Errors name the file.
class BvhRows {
 public:
  BvhRows(std::filesystem::path path, std::vector<MotionBone> bones, double fps, double scale,
          std::size_t moving_bones = 1);

  // `positions` of the moving bones in their parents, at least; `rotations` of all.
  void write(const std::vector<Eigen::Vector3d>& positions, const std::vector<Eigen::Quaterniond>& rotations);
  void finish();

 private:
  void bone(std::size_t index, int depth);

  AtomicFile file_;
  std::vector<MotionBone> bones_;
  double fps_;
  double scale_;
  std::size_t moving_bones_;
  std::string hierarchy_;
  std::string rows_;
  std::vector<std::size_t> order_;  // bones as the hierarchy lists them
  std::int64_t frames_ = 0;
  std::vector<Eigen::Vector3d> angles_;  // of the row before, z y x [rad], one per bone
};

// Writes a whole motion; bones are rigid (position channels only at the root).
void writeBvh(const SourceMotion& motion, const std::filesystem::path& path, double scale = 1.0);

}  // namespace depthmocap
