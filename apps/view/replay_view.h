#pragma once
#include <filesystem>
#include <memory>

#include "apps/view/recording_tracker.h"
#include "apps/view/view_options.h"
#include "libtracker/recording/recording.h"
#include "libtracker/session/frame_sink.h"

namespace depthmocap {

// The live page of `replay --view`: its recording, played while it is tracked, and the other recordings to open.
class ReplayView : public FrameSink {
 public:
  // Starts the server. `total`: frames that there will be; `people`: most that are tracked. The tracker outlives the
  // view.
  ReplayView(const ViewOptions& options, const NamedRecording& recording, std::size_t total, int people,
             RecordingTracker& tracker);
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
