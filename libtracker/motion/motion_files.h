#pragma once
#include <filesystem>
#include <optional>
#include <vector>

#include "libtracker/motion/retarget.h"

namespace depthmocap {

// How motion files are read.
struct LoadOptions {
  // Skeleton of an AMC; without it <subject>.asf beside <subject>_<trial>.amc, or the only ASF of the folder.
  std::optional<std::filesystem::path> asf;
  // [1/s] (> 0) of files that give no rate: every AMC (the motions in use were reduced to 30), and a BVH whose frame
  // time is none.
  double fps_if_unsaid = 30.0;
  double max_fps = 30.0;                      // [1/s] (> 0) faster motions are resampled to this rate
  std::optional<double> bvh_metres_per_unit;  // (> 0) a BVH file names no unit; without it detectMetresPerUnit()
  BoneMap bones;                              // which bones are which, where their names do not say it
  // Conversions of CMU's motions begin with one frame of T-pose, some of CMU's own with one in which limbs or root are
  // zero. Such a first frame, from which the body jumps, is replaced by the second one, so that frame numbers stay as
  // they are.
  bool repair_first_frame = true;
  void validate() const;  // throws Error naming field, value and rule
};

// Reads an .amc or .bvh file and retargets it; clip.name is the file's stem. The warnings say what was guessed or left
// out, and where the body cannot follow the file: a joint more than 20 mm off on average, many frames beyond the joint
// limits. Error naming the file.
RetargetResult retargetMotionFile(const std::filesystem::path& path, const LoadOptions& options = {});
MotionClip loadMotion(const std::filesystem::path& path, const LoadOptions& options = {});

// Every .amc and .bvh file below a folder, sorted by path. Error if it is no folder.
std::vector<std::filesystem::path> findMotionFiles(const std::filesystem::path& folder);

// The ASF file that belongs to an AMC file. Error if there is none.
std::filesystem::path asfFor(const std::filesystem::path& amc);

}  // namespace depthmocap
