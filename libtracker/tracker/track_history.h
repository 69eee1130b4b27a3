#pragma once
#include <limits>

#include "depthmocap/pose.h"
#include "depthmocap/track_state.h"

namespace depthmocap {

// The last two poses and how long the actor has been without evidence.
class TrackHistory {
 public:
  [[nodiscard]] TrackState state() const { return state_; }
  [[nodiscard]] bool hasPose() const { return state_ != TrackState::Lost; }
  [[nodiscard]] const Pose& prev() const { return q_prev_; }
  // q_-2 for a frame at `time_s`: shifted so that q_-1 - q_-2 is the change to expect until then, also where frames are
  // missing or irregular.
  [[nodiscard]] Pose prev2(double time_s) const;
  // Constant-velocity guess for a frame at `time_s`.
  [[nodiscard]] Pose predicted(double time_s) const { return 2.0 * q_prev_ - prev2(time_s); }

  // How long before `time_s` the actor was last seen [s]; infinite if never.
  [[nodiscard]] double unseen(double time_s) const;
  // How far the actor would have walked on since then [m], world.
  [[nodiscard]] Eigen::Vector3d walkedOn(double time_s) const;

  // A believed pose; `fresh` forgets the velocity (first pose, pose of a global search).
  void accept(const Pose& q, double time_s, bool fresh);
  // The world is another one: p_new = R_new_before * p_before. The velocity is forgotten: the camera has moved.
  void turnWorld(const Eigen::Matrix3d& R_new_before);
  // No evidence at `time_s`: the pose rests where it is; after coast_s the actor is lost.
  void miss(double time_s, double coast_s);

 private:
  TrackState state_ = TrackState::Lost;
  Pose q_prev_ = Pose::Zero();
  Pose velocity_ = Pose::Zero();                                       // per second
  double time_s_ = 0;                                                  // of q_prev
  double evidence_time_s_ = -std::numeric_limits<double>::infinity();  // of the last accepted pose
  Eigen::Vector3d walk_ = Eigen::Vector3d::Zero();                     // [m/s] steadied velocity of the root
};

}  // namespace depthmocap
