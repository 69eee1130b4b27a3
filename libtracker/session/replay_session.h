#pragma once
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "libtracker/recording/recording.h"
#include "libtracker/recording/unreadable_frames.h"
#include "libtracker/session/pose_pipeline.h"

namespace depthmocap {

struct ReplaySessionOptions {
  double look_ahead_s = kLookAhead_s;  // [s] (0 .. 1) each pose is steadied by the frames this long before and after it
  double smooth = 0;                   // [0, 1] of the output filter; 0 = off
  // 2: the first seconds are tracked before, to fit the bodies of people who were not measured (fitBodies); 1: not.
  int passes = 2;
  std::int64_t first_frame = 0;  // by the recording's frame numbers
  std::int64_t last_frame = std::numeric_limits<std::int64_t>::max();
  std::size_t most_frames = std::numeric_limits<std::size_t>::max();
  std::string name = "recording";  // of the recording, in messages
};

// Callbacks of a long run. Each may be empty.
struct ReplayHooks {
  std::function<void(std::size_t done, std::size_t total)> progress;
  std::function<void(const std::string& message)> warn;  // at the end: frames that cannot be read, a reason a line
  std::function<bool()> stopped;                         // true once the run shall end
};

// Tracks a recording, from its first frame on with the bodies of its people: every chosen frame, in order,
// deterministic.
class ReplaySession {
 public:
  // Throws Error where no frame is chosen. All outlive the session.
  ReplaySession(RecordingReader& reader, Tracker& tracker, const ReplaySessionOptions& options);
  void addSink(FrameSink& sink) { pipeline_.addSink(sink); }

  // Frames that cannot be read are frames without measurement: the tracker coasts over them or loses the actor, and the
  // rest is still tracked. Throws Error where not one frame can be read.
  void run(const ReplayHooks& hooks = {});

  [[nodiscard]] std::size_t frameCount() const { return chosen_.size(); }
  [[nodiscard]] RunStats& stats() { return stats_; }

 private:
  std::size_t fitFirst(const ReplayHooks& hooks);
  bool read(std::size_t i);

  RecordingReader& reader_;
  Tracker& tracker_;
  const ReplaySessionOptions options_;
  std::vector<std::size_t> chosen_;  // indices of frames
  RunStats stats_;
  PosePipeline pipeline_;
  DepthFrame frame_;
  UnreadableFrames unreadable_;
};

}  // namespace depthmocap
