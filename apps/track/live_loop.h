#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "apps/track/live_figures.h"
#include "depthmocap/depth_frame.h"
#include "depthmocap/tracker.h"
#include "libtracker/sensor/capture.h"
#include "libtracker/sensor/newest_frame.h"
#include "libtracker/sensor/recorder.h"

namespace depthmocap {

// What a live run knows about itself at one moment.
struct LiveStatus {
  CaptureStatus camera;
  RecorderStatus recording;   // all zero without --record
  std::int64_t tracked = 0;   // frames that went through the tracker
  std::int64_t replaced = 0;  // frames dropped because a newer one was there
  TrackState state = TrackState::Lost;
  double fps = 0;         // [1/s] of the tracker's output, over the last second
  double latency_ms = 0;  // from the sensor's time stamp until all outputs had the frame, of the last one
};

// Receives what a live run makes: files, a network stream, a viewer. Called on the tracker's thread; what takes long
// here costs frames, never delay.
class LiveSink {
 public:
  virtual ~LiveSink() = default;
  // Both are valid during the call only.
  virtual void onFrame(const DepthFrame& frame, const TrackedFrame& tracked) = 0;
  // About five times a second, also while no frame comes.
  virtual void onStatus(const LiveStatus&) {}
};

struct LiveLimits {
  double seconds = 0;             // [s] 0 = no limit
  std::function<bool()> stopped;  // true once the run shall end
};

// Camera -> newest frame -> tracker -> sinks. A frame is never queued for the tracker: while it works, only the newest
// one waits.
class LiveLoop {
 public:
  // `recorder` may be null; it gets every frame, also those that the tracker does not get to. All outlive the loop.
  LiveLoop(DepthSource& source, Tracker& tracker, Recorder* recorder);
  void addSink(LiveSink& sink) { sinks_.push_back(&sink); }
  // Until the source ends or a limit is reached. Throws what the source, the tracker or a sink throws.
  void run(const LiveLimits& limits);
  [[nodiscard]] LiveStatus status() const;
  [[nodiscard]] const LiveFigures& figures() const { return figures_; }

 private:
  bool hand(SensorFrame& frame);
  void track(const SensorFrame& frame);
  void tellStatus();
  void collectFigures();

  DepthSource& source_;
  Tracker& tracker_;
  Recorder* recorder_;
  std::vector<LiveSink*> sinks_;
  NewestFrame newest_;
  std::unique_ptr<Capture> capture_;
  LiveStatus status_;
  LiveFigures figures_;
  SensorClock::time_point last_told_{};
  std::vector<SensorClock::time_point> recent_;  // when frames of the last second were done
};

}  // namespace depthmocap
