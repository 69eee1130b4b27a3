#pragma once
#include <filesystem>
#include <memory>

#include "apps/track/track_options.h"
#include "depthmocap/depth_frame.h"
#include "depthmocap/tracked_frame.h"
#include "libtracker/recording/recording.h"

namespace depthmocap {

// The live page of a recording: keeps what the tracker said about each frame and plays it, at the speed and from the
// place that a page asks for, while the tracker works on. The tracker only adds; all else is done on other threads.
class ReplayView {
 public:
  // Starts the server. `total`: frames that there will be.
  ReplayView(const ViewOptions& options, const std::filesystem::path& recording, std::size_t total);
  ~ReplayView();
  ReplayView(const ReplayView&) = delete;
  ReplayView& operator=(const ReplayView&) = delete;

  // Frame number `index` of the recording's reader has been tracked.
  void add(std::size_t index, const TrackedFrame& tracked, double fps);
  // No frame will follow; the page stays.
  void tracked();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace depthmocap
