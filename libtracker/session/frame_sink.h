#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

#include "depthmocap/depth_frame.h"
#include "depthmocap/tracked_frame.h"
#include "libtracker/sensor/capture.h"
#include "libtracker/sensor/recorder.h"

namespace depthmocap {

// State of a session with a camera at one moment.
struct SessionStatus {
  CaptureStatus camera;
  RecorderStatus recording;   // all zero where nothing is recorded
  std::int64_t tracked = 0;   // frames that went through the tracker
  std::int64_t replaced = 0;  // frames dropped because a newer one was there
  TrackState state = TrackState::Lost;
  double fps = 0;         // [1/s] of the tracker's output, over the last second
  double latency_ms = 0;  // from the sensor's time stamp until all sinks had the frame, of the last one
};

// One frame on its way out of a session.
struct SessionFrame {
  std::size_t index;                            // of the frame in its recording; of a camera: how many came before
  const DepthFrame& depth;                      // as the tracker saw it
  const TrackedFrame& tracked;                  // after look-ahead and smoothing; of several people the first
  double fps;                                   // [1/s] of the tracker at that moment
  std::span<const TrackedFrame* const> people;  // all of them, by their numbers; who is not there is lost
};

// Receives what a session makes: files, a network stream, a viewer. Called on one thread, frames in order. With a
// camera, what takes long here costs frames, never delay.
class FrameSink {
 public:
  virtual ~FrameSink() = default;
  // The frame and everything that it refers to are valid during the call only.
  virtual void onFrame(const SessionFrame& frame) = 0;
  // With a camera, about five times a second, also while no frame comes.
  virtual void onStatus(const SessionStatus&) {}
};

}  // namespace depthmocap
