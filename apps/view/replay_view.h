#pragma once
#include <filesystem>
#include <memory>

#include "apps/view/view_options.h"
#include "libtracker/recording/recording.h"
#include "libtracker/session/frame_sink.h"

namespace depthmocap {

// The live page of a recording: keeps what the tracker said about each frame and plays it, at the speed and from the
// place that a page asks for, while the tracker works on. The tracker only adds; all else is done on other threads.
class ReplayView : public FrameSink {
 public:
  // Starts the server. `correction`: as openRecording(); `total`: frames that there will be.
  ReplayView(const ViewOptions& options, const std::filesystem::path& recording, const RecordingCorrection& correction,
             std::size_t total);
  ~ReplayView() override;
  ReplayView(const ReplayView&) = delete;
  ReplayView& operator=(const ReplayView&) = delete;

  void onFrame(const SessionFrame& frame) override;
  // No frame will follow; the page stays.
  void tracked();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace depthmocap
