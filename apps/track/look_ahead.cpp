#include "apps/track/look_ahead.h"

#include <CLI/CLI.hpp>
#include <utility>

#include "libtracker/core/check.h"
#include "libtracker/tracker/pose_fields.h"

namespace depthmocap {
namespace {

constexpr double kMost_s = 1.0;

}  // namespace

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

void addLookAheadOption(CLI::App& command, double& seconds) {
  command
      .add_option("--look-ahead", seconds,
                  "Each pose is steadied by the frames up to so many seconds before and after it; 0 = off, as live is")
      ->check(CLI::Range(0.0, kMost_s))
      ->capture_default_str();
}

}  // namespace depthmocap
