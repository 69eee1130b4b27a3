#pragma once
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "depthmocap/joints.h"
#include "libtracker/recording/track_files.h"

namespace depthmocap {

// Which frames are compared, and how.
struct EvaluationOptions {
  std::int64_t first = 0;  // frame numbers, both ends included
  std::int64_t last = std::numeric_limits<std::int64_t>::max();
  double hit_radius_m = 0.10;  // [m] a joint this near its truth, or nearer, is a hit
  // Takes the pelvis' position off every joint of a frame first, and the pelvis out of the means: for a truth whose
  // place in the room is not to be trusted.
  bool root_relative = false;
};

// A mean over nothing is NaN. Per-joint arrays are in the order of Joint.
struct JointFigures {
  int frames = 0;    // truth frames in state `tracking`; the others are no truth
  int compared = 0;  // of these, frames that the tracker has a pose for (tracking or coasting)
  double lost_fraction = 0;
  // [m] mean distance to the truth over compared frames.
  double mean_error_m = 0;
  std::array<double, kJointCount> error_m{};
  // Share of `frames` in which the joint is a hit; a frame without a pose is a miss.
  double mean_hit_rate = 0;
  std::array<double, kJointCount> hit_rate{};
  double mean_bone_direction_error_deg =
      0;  // [deg] angle between tracked and true bone, over bones and compared frames
  // [m/s^2] mean size of the joints' acceleration, from second differences of neighbouring rows with a pose.
  double jitter_m_s2 = 0;        // of the tracked joints
  double truth_jitter_m_s2 = 0;  // of the truth: how much of it is motion
};

// Frames are matched by number; a truth frame that `tracked` does not have counts as lost.
JointFigures evaluateJoints(const std::vector<JointsRow>& tracked, const std::vector<JointsRow>& truth,
                            const EvaluationOptions& options);

}  // namespace depthmocap
