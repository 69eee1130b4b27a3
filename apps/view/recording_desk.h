#pragma once
#include <memory>

#include "apps/view/live_page.h"
#include "apps/view/recording_shelf.h"
#include "apps/view/recording_tracker.h"

namespace depthmocap {

// Recordings on the page: GET /recordings lists them, "open" tracks one and plays it in place of what the command
// shows, "close" ends that, and GET /export sends the files of the one that was tracked last. One is tracked at a time,
// on a thread of its own.
class RecordingDesk {
 public:
  // Before the page starts; page and tracker outlive it. `people`: tracked where a page names no number.
  RecordingDesk(LivePage& page, RecordingShelf shelf, RecordingTracker& tracker, int people);
  ~RecordingDesk();  // stops the page's server, whose requests come here, and what is being tracked
  RecordingDesk(const RecordingDesk&) = delete;
  RecordingDesk& operator=(const RecordingDesk&) = delete;

  // More would fill the memory with what the player keeps: ten minutes at 30 per second.
  static constexpr std::size_t kMostFrames = 18000;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace depthmocap
