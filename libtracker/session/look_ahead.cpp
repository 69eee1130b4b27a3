#include "libtracker/session/look_ahead.h"

#include <utility>

#include "libtracker/core/check.h"
#include "libtracker/tracker/pose_fields.h"

namespace depthmocap {
void LookAhead::add(std::size_t index, DepthFrame& depth, const TrackedFrame& tracked, const Actor& actor) {
  if (spare_.empty()) spare_.emplace_back();
  waiting_.splice(waiting_.end(), spare_, spare_.begin());
  Frame& frame = waiting_.back();
  frame.index = index;
  std::swap(frame.depth, depth);
  frame.tracked = tracked;
  frame.actor = actor;
  const bool joined = tracked.state == TrackState::Tracking && state_before_ == TrackState::Tracking &&
                      !tracked.reinitialised && tracked.R_world_camera == R_world_camera_before_;
  state_before_ = tracked.state;
  R_world_camera_before_ = tracked.R_world_camera;
  smoother_.add({tracked.time_s, tracked.q, joined});
}

const LookAhead::Frame* LookAhead::next() {
  const std::optional<Pose> q = smoother_.next();
  if (!q) return nullptr;
  DMC_CHECK(!waiting_.empty());
  spare_.splice(spare_.end(), waiting_, waiting_.begin());
  Frame& frame = spare_.back();
  if (*q != frame.tracked.q) setPose(*q, frame.actor, fk_, frame.tracked);
  return &frame;
}

}  // namespace depthmocap
