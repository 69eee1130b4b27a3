#include "libtracker/tracker/track_history.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "libtracker/skeleton/forward_kinematics.h"

namespace depthmocap {
namespace {

constexpr double kMaxStep_s = 0.1;  // a velocity is not believed for longer than this
constexpr double kWalkRate = 0.2;   // a frame; single velocities are too noisy to follow somebody who is hidden,
constexpr double kWalk_s = 1.0;     // which is worth trying for so long

// The change from b to a; headings are angles on a circle.
Pose difference(const Pose& a, const Pose& b) {
  Pose d = a - b;
  d[kRootRy] = std::remainder(d[kRootRy], 2.0 * std::numbers::pi);
  return d;
}

}  // namespace

Pose TrackHistory::prev2(double time_s) const {
  return q_prev_ - velocity_ * std::clamp(time_s - time_s_, 0.0, kMaxStep_s);
}

void TrackHistory::accept(const Pose& q, double time_s, bool fresh) {
  const double dt = time_s - evidence_time_s_;  // q_prev is as old as the evidence for it
  velocity_ = fresh || dt <= 0 ? Pose(Pose::Zero()) : Pose(difference(q, q_prev_) / dt);
  if (!fresh) walk_ += kWalkRate * (velocity_.head<3>() - walk_);  // a search for the pose does not stop who walks
  q_prev_ = q;
  time_s_ = evidence_time_s_ = time_s;
  state_ = TrackState::Tracking;
}

void TrackHistory::turnWorld(const Eigen::Matrix3d& R_new_before) {
  q_prev_.head<3>() = R_new_before * q_prev_.head<3>();
  setLocalRotation(Bone::Root, R_new_before * localRotation(Bone::Root, q_prev_), q_prev_);
  velocity_.setZero();
  walk_.setZero();
}

double TrackHistory::unseen(double time_s) const {
  return time_s - evidence_time_s_;
}

Eigen::Vector3d TrackHistory::walkedOn(double time_s) const {
  return walk_ * std::clamp(unseen(time_s), 0.0, kWalk_s);
}

void TrackHistory::miss(double time_s, double coast_s) {
  if (state_ == TrackState::Lost) return;
  velocity_.setZero();
  time_s_ = time_s;
  state_ = time_s - evidence_time_s_ > coast_s ? TrackState::Lost : TrackState::Coasting;
}

}  // namespace depthmocap
