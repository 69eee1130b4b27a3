#pragma once
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "apps/view/recording_tracker.h"
#include "apps/view/view_options.h"
#include "depthmocap/tracker.h"
#include "libtracker/recording/recording.h"
#include "libtracker/session/frame_sink.h"

namespace depthmocap {

// The live page of a camera: shows what the tracker makes and does what the page asks for: record, calibrate, reset,
// lock on another person, open a recording. On the tracker's thread, which only copies a frame, and only where somebody
// could take it; messages are made and sent in the background.
class LiveView : public FrameSink {
 public:
  // Starts the server. Both trackers outlive the view.
  LiveView(const ViewOptions& options, const std::string& source, const RecordingInfo& info, const Models& models,
           int threads, Tracker& tracker, RecordingTracker& recordings);
  ~LiveView() override;
  LiveView(const LiveView&) = delete;
  LiveView& operator=(const LiveView&) = delete;

  void onFrame(const SessionFrame& frame) override;
  void onStatus(const SessionStatus& status) override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace depthmocap
