#pragma once
#include <cstddef>
#include <list>

#include "depthmocap/actor.h"
#include "depthmocap/depth_frame.h"
#include "depthmocap/tracked_frame.h"
#include "libtracker/skeleton/forward_kinematics.h"
#include "libtracker/smooth/look_ahead_smoother.h"

namespace depthmocap {

// Tracked frames wait here for those that follow, and leave with the pose that all of them say together. Poses of one
// unbroken track only: a frame without evidence, a pose found anew and a turn of the world are borders.
class LookAhead {
 public:
  struct Frame {
    std::size_t index = 0;  // of the caller
    DepthFrame depth;
    TrackedFrame tracked;
    Actor actor;
  };
  // See LookAheadSmoother; 0 = frames leave as they came, at once.
  explicit LookAhead(double half_width_s) : smoother_(half_width_s) {}

  // `depth`: its memory is exchanged for another frame's. `actor`: the body in use at that frame.
  void add(std::size_t index, DepthFrame& depth, const TrackedFrame& tracked, const Actor& actor);
  // No frame will follow.
  void finish() { smoother_.finish(); }
  // The oldest frame that has not left, once it is due; null before. Valid until the next call.
  const Frame* next();

 private:
  LookAheadSmoother smoother_;
  std::list<Frame> waiting_;
  std::list<Frame> spare_;  // their memory is used again
  TrackState state_before_ = TrackState::Lost;
  Eigen::Matrix3d R_world_camera_before_ = Eigen::Matrix3d::Zero();
  ForwardKinematics fk_;
};

// [s] Best for the mean error of rendered walks, runs and kicks among the widths that do not flatten punches.
inline constexpr double kLookAhead_s = 0.13;

}  // namespace depthmocap
