#pragma once
#include <cstddef>
#include <deque>
#include <list>
#include <span>
#include <vector>

#include "depthmocap/actor.h"
#include "depthmocap/depth_frame.h"
#include "depthmocap/tracked_frame.h"
#include "libtracker/skeleton/forward_kinematics.h"
#include "libtracker/smooth/look_ahead_smoother.h"

namespace depthmocap {

// Tracked frames wait here for those that follow, and leave with the poses that all of them say together. Poses of one
// unbroken track only: a frame without evidence, a pose found anew and a turn of the world are borders.
class LookAhead {
 public:
  // One person in a waiting frame.
  struct Person {
    TrackedFrame tracked;
    Actor actor;  // the body in use at that frame
  };
  struct Frame {
    std::size_t index = 0;  // of the caller
    DepthFrame depth;
    std::vector<Person> people;
  };
  // See LookAheadSmoother; 0 = frames leave as they came, at once.
  LookAhead(double half_width_s, std::size_t people);

  // Everybody in the next frame, and the bodies in use. `depth`: its memory is exchanged for another frame's.
  void add(std::size_t index, DepthFrame& depth, std::span<const TrackedFrame* const> people,
           std::span<const Actor* const> actors);
  // No frame will follow.
  void finish();
  // The oldest frame that has not left, once it is due; null before. Valid until the next call.
  const Frame* next();

 private:
  // The track of one person.
  struct Lane {
    LookAheadSmoother smoother;
    std::deque<Pose> ready;  // poses of the oldest frames that wait
    TrackState state_before = TrackState::Lost;
    Eigen::Matrix3d R_world_camera_before = Eigen::Matrix3d::Zero();
  };

  std::vector<Lane> lanes_;
  std::list<Frame> waiting_;
  std::list<Frame> spare_;  // their memory is used again
  ForwardKinematics fk_;
};

// [s] Best for the mean error of rendered walks, runs and kicks among the widths that do not flatten punches.
inline constexpr double kLookAhead_s = 0.13;

}  // namespace depthmocap
