#pragma once
#include <cstddef>
#include <vector>

#include "libtracker/posedb/pose_database.h"
#include "libtracker/skeleton/motion_clip.h"

namespace depthmocap {

// Parameters of the pose database's construction.
struct PoseDatabaseConfig {
  double threshold_m =
      0.02;            // [m] (>= 0) a pose is kept if some joint is farther than this from that of every kept pose
  bool mirror = true;  // every motion also as its mirror image
  double beyond_limits_rad =
      0.35;               // [rad] (>= 0) poses farther beyond a joint limit than this are errors of capture: left out
  int threads = 1;        // (>= 1); the result does not depend on it
  void validate() const;  // throws Error naming field, value and rule
};

// What became of the frames.
struct PoseDatabaseCounts {
  std::size_t frames = 0;         // of all clips, mirror images counted
  std::size_t beyond_limits = 0;  // left out as errors of capture
  std::size_t kept = 0;
};

struct PoseDatabaseResult {
  PoseDatabase database;
  PoseDatabaseCounts counts;
};

// The poses of all clips without place and heading (root_tx = root_ty = root_tz = root_ry = 0), near-duplicates thinned
// out: in the order of the clips a pose is kept if its joints on the average body differ from every kept pose by more
// than the threshold. One source a clip, and one "<name>:mirrored" for its mirror image; a clip of which nothing is new
// has count 0. Deterministic. `origin` is left to the caller.
PoseDatabaseResult buildPoseDatabase(const std::vector<MotionClip>& clips, const PoseDatabaseConfig& config);

}  // namespace depthmocap
