#pragma once
#include <memory>

#include "apps/view/live_page.h"
#include "libtracker/recording/recording.h"
#include "libtracker/session/frame_sink.h"

namespace depthmocap {

// Plays a recording on the page: keeps what the tracker said about each frame and plays it, at the speed and from the
// place that a page asks for, while the tracker works on. The tracker only adds; all else is done on another thread.
class RecordingPlayer : public FrameSink {
 public:
  // The commands that it obeys.
  static const std::vector<std::string> kControls;

  // `total`: frames that there will be. The page outlives it.
  RecordingPlayer(LivePage& page, PageHolder holder, std::unique_ptr<RecordingReader> reader, std::size_t total);
  ~RecordingPlayer() override;
  RecordingPlayer(const RecordingPlayer&) = delete;
  RecordingPlayer& operator=(const RecordingPlayer&) = delete;

  void onFrame(const SessionFrame& frame) override;
  // No frame will follow.
  void tracked();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace depthmocap
