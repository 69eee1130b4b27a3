#include "libtracker/session/look_ahead.h"

#include <algorithm>
#include <utility>

#include "libtracker/core/check.h"
#include "libtracker/tracker/pose_fields.h"

namespace depthmocap {

LookAhead::LookAhead(double reach_s, std::size_t people) {
  for (std::size_t i = 0; i < people; ++i) lanes_.push_back({ClipSmoother(reach_s), {}});
}

void LookAhead::add(std::size_t index, DepthFrame& depth, std::span<const Seen> people) {
  DMC_CHECK(people.size() == lanes_.size());
  if (spare_.empty()) spare_.emplace_back();
  waiting_.splice(waiting_.end(), spare_, spare_.begin());
  Frame& frame = waiting_.back();
  frame.index = index;
  std::swap(frame.depth, depth);
  frame.people.resize(lanes_.size());
  for (std::size_t i = 0; i < lanes_.size(); ++i) {
    Lane& lane = lanes_[i];
    const TrackedFrame& tracked = *people[i].tracked;
    frame.people[i].tracked = tracked;
    frame.people[i].actor = *people[i].actor;
    const bool joined = tracked.state == TrackState::Tracking && lane.state_before == TrackState::Tracking &&
                        !tracked.reinitialised && tracked.R_world_camera == lane.R_world_camera_before;
    lane.state_before = tracked.state;
    lane.R_world_camera_before = tracked.R_world_camera;
    const bool is_seen = tracked.state == TrackState::Tracking;
    lane.smoother.add({tracked.time_s, tracked.q, joined, is_seen ? *people[i].evidence : NormalEquations{}});
  }
}

void LookAhead::finish() {
  for (Lane& lane : lanes_) lane.smoother.finish();
}

// A frame leaves when the poses of all its people are due.
const LookAhead::Frame* LookAhead::next() {
  for (Lane& lane : lanes_) {
    while (const std::optional<Pose> q = lane.smoother.next()) lane.ready.push_back(*q);
  }
  if (std::ranges::any_of(lanes_, [](const Lane& lane) { return lane.ready.empty(); })) return nullptr;
  DMC_CHECK(!waiting_.empty());
  spare_.splice(spare_.end(), waiting_, waiting_.begin());
  Frame& frame = spare_.back();
  for (std::size_t i = 0; i < lanes_.size(); ++i) {
    const Pose q = lanes_[i].ready.front();
    lanes_[i].ready.pop_front();
    Person& person = frame.people[i];
    if (q != person.tracked.q) setPose(q, person.actor, fk_, person.tracked);
  }
  return &frame;
}

}  // namespace depthmocap
