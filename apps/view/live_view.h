#pragma once
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "apps/track/live_loop.h"
#include "apps/track/track_options.h"
#include "libtracker/recording/recording.h"

namespace depthmocap {

// The live page of a camera: shows what the tracker makes and does what the page asks for: record, calibrate, reset,
// lock on another person. On the tracker's thread, which only copies a frame, and only where somebody could take it;
// messages are made and sent in the background.
class LiveView {
 public:
  // Starts the server. The tracker outlives the view.
  LiveView(const TrackOptions& options, const std::string& source, const RecordingInfo& info, Tracker& tracker);
  ~LiveView();
  LiveView(const LiveView&) = delete;
  LiveView& operator=(const LiveView&) = delete;

  void onFrame(const DepthFrame& frame, const TrackedFrame& shown);
  void onStatus(const LiveStatus& status);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace depthmocap
