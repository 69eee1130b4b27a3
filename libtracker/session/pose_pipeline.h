#pragma once
#include <vector>

#include "depthmocap/tracker.h"
#include "libtracker/session/frame_sink.h"
#include "libtracker/session/look_ahead.h"
#include "libtracker/session/rate_meter.h"
#include "libtracker/session/run_stats.h"
#include "libtracker/smooth/pose_smoother.h"

namespace depthmocap {

// Tracker -> look-ahead -> smoother -> sinks: the way of every frame, whether it comes from a recording or a camera.
class PosePipeline {
 public:
  // `look_ahead_s`: see ClipSmoother; 0 = every frame leaves at once. `smooth`: see PoseSmoother.
  PosePipeline(Tracker& tracker, double look_ahead_s, double smooth, RunStats& stats);
  void addSink(FrameSink& sink) { sinks_.push_back(&sink); }

  // Tracks a frame; frames that have waited long enough go to the sinks. The memory of `depth` may be exchanged.
  // Returns the state of this frame.
  TrackState process(std::size_t index, DepthFrame& depth);
  // No frame will follow: those that wait go to the sinks.
  void finish();
  void tell(const SessionStatus& status);
  [[nodiscard]] double fps() { return rate_.perSecond(); }

 private:
  // One person on the way out.
  struct Lane {
    PoseSmoother smoother;
    TrackedFrame smoothed;
  };
  void passOn();
  void give(std::size_t index, const DepthFrame& depth);
  const TrackedFrame& smoothed(const TrackedFrame& tracked, const Actor& actor, Lane& lane);

  Tracker& tracker_;
  const bool looks_ahead_;
  LookAhead waiting_;
  std::vector<Lane> lanes_;
  std::vector<const TrackedFrame*> leaving_;  // the people of the frame that leaves
  std::vector<LookAhead::Seen> seen_;         // in the present frame, one per person
  ForwardKinematics fk_;
  RunStats& stats_;
  RateMeter rate_;
  std::vector<FrameSink*> sinks_;
};

}  // namespace depthmocap
