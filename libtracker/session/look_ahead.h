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
#include "libtracker/smooth/clip_smoother.h"

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
  // See ClipSmoother; 0 = frames leave as they came, at once.
  LookAhead(double reach_s, std::size_t people);

  // One person in the next frame.
  struct Seen {
    const TrackedFrame* tracked = nullptr;
    const Actor* actor = nullptr;               // the body in use
    const NormalEquations* evidence = nullptr;  // of the pose; see ClipSmoother
  };
  // Everybody in the next frame. `depth`: its memory is exchanged for another frame's.
  void add(std::size_t index, DepthFrame& depth, std::span<const Seen> people);
  // No frame will follow.
  void finish();
  // The oldest frame that has not left, once it is due; null before. Valid until the next call.
  const Frame* next();

 private:
  // The track of one person.
  struct Lane {
    ClipSmoother smoother;
    std::deque<Pose> ready;  // poses of the oldest frames that wait
    TrackState state_before = TrackState::Lost;
    Eigen::Matrix3d R_world_camera_before = Eigen::Matrix3d::Zero();
  };

  std::vector<Lane> lanes_;
  std::list<Frame> waiting_;
  std::list<Frame> spare_;  // their memory is used again
  ForwardKinematics fk_;
};

// [s] Nine frames on either side at the usual rate; chosen by hand.
inline constexpr double kLookAhead_s = 0.3;

}  // namespace depthmocap
