#pragma once
#include <functional>
#include <memory>

#include "libtracker/sensor/newest_frame.h"
#include "libtracker/session/live_figures.h"
#include "libtracker/session/pose_pipeline.h"

namespace depthmocap {

struct LiveSessionOptions {
  double seconds = 0;  // [s] (>= 0) by the sensor's time; 0 = no limit
  double smooth = 0;   // [0, 1] of the output filter; 0 = off
};

// Tracks a camera. A frame is never queued for the tracker: while it works, only the newest one waits. A recorder gets
// every frame, also those that the tracker does not get to.
class LiveSession {
 public:
  // `recorder` may be null. All outlive the session.
  LiveSession(DepthSource& source, Tracker& tracker, Recorder* recorder, const LiveSessionOptions& options);
  void addSink(FrameSink& sink) { pipeline_.addSink(sink); }

  // Until the source ends, the time is over or `stopped` (may be empty) says so. Throws what the source, the tracker or
  // a sink throws.
  void run(const std::function<bool()>& stopped = {});

  [[nodiscard]] RunStats& stats() { return stats_; }
  [[nodiscard]] const LiveFigures& figures() const { return figures_; }

 private:
  bool hand(SensorFrame& frame);
  void track(SensorFrame& frame);
  SessionStatus status();
  void tellStatus();
  void collectFigures();

  DepthSource& source_;
  Recorder* recorder_;
  const LiveSessionOptions options_;
  RunStats stats_{Durations::Keep::Binned};
  PosePipeline pipeline_;
  NewestFrame newest_;
  std::unique_ptr<Capture> capture_;
  SessionStatus status_;
  LiveFigures figures_;
  SensorClock::time_point last_told_{};
};

}  // namespace depthmocap
