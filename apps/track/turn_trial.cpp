#include "apps/track/turn_trial.h"

#include <algorithm>

#include "depthmocap/tracker.h"
#include "libtracker/recording/turned_recording.h"

namespace depthmocap {
namespace {

constexpr std::size_t kKept = 6;         // frames: enough for a majority, little enough to wait for
constexpr double kApart_s = 0.3;         // between two of them, so that they differ
constexpr std::size_t kClearlyMore = 2;  // frames tracked more than before: a turned body is sometimes taken for a pose

std::size_t trackedWhenTurned(const std::vector<DepthFrame>& frames, int turn_deg, const Models& models,
                              const CameraModel& camera, const TrackerConfig& config) {
  Tracker tracker(models, turnedCamera(camera, turn_deg), config);
  std::size_t tracked = 0;
  DepthFrame turned;
  for (const DepthFrame& frame : frames) {
    turned.frame = frame.frame;
    turned.time_s = frame.time_s;
    turnDepth(frame.depth, turn_deg, turned.depth);
    tracked += tracker.process(turned).state == TrackState::Tracking ? 1 : 0;
  }
  return tracked;
}

}  // namespace

void TurnTrial::onFrame(const SessionFrame& frame) {
  if (kept_.size() >= kKept) return;
  if (!kept_.empty() && frame.depth.time_s < kept_.back().time_s + kApart_s) return;
  kept_.push_back(frame.depth);
  tracked_ += frame.tracked.state == TrackState::Tracking ? 1 : 0;
}

std::optional<int> TurnTrial::turnThatHelps(const Models& models, const CameraModel& camera,
                                            const TrackerConfig& config, int turned_deg) const {
  std::optional<int> best;
  std::size_t most = std::max(kept_.size() / 2, tracked_ + kClearlyMore - 1);
  for (const int turn_deg : {90, 180, 270}) {
    const std::size_t tracked = trackedWhenTurned(kept_, turn_deg, models, camera, config);
    if (tracked <= most) continue;
    most = tracked;
    best = (turned_deg + turn_deg) % 360;
  }
  return best;
}

}  // namespace depthmocap
