#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "depthmocap/actor.h"
#include "depthmocap/camera.h"
#include "depthmocap/depth_frame.h"
#include "depthmocap/export.h"
#include "depthmocap/models.h"
#include "depthmocap/recording.h"
#include "depthmocap/tracked_frame.h"
#include "depthmocap/tracker.h"

namespace depthmocap {

struct SessionOptions {
  std::optional<Models> models{};  // none: Models::shipped()
  std::optional<Actor> actor{};  // as its file says; none: an average body whose shape is fitted over the first seconds
  // [s] (0 .. 1) each pose is steadied by the frames this long before and after it; none: 0.3 for a recording, as
  // `depthmocap replay`. A camera has no look-ahead.
  std::optional<double> look_ahead_s{};
  // Over a recording without an actor, 1 or 2. 2: its first seconds are tracked before, so that the first frame has the
  // body that was fitted over them. A camera has one.
  int passes = 2;
  double smooth = 0;                // [0, 1] of the output filter; 0 = off
  double seconds = 0;               // [s] (>= 0) of a camera's time; 0 = until it ends or `stopped`
  int people = 1;                   // (1 .. 6) tracked at the same time
  int threads = 2;                  // (>= 1) for the tracker; results do not depend on it
  std::function<bool()> stopped{};  // asked between frames; true ends the run. May be empty
  // Told at the end of a recording of frames that cannot be read, a line for each reason. May be empty.
  std::function<void(const std::string&)> warn{};
};

// Tracks a recording or a camera from its source to your callback, as the program does. Not thread-safe.
class DEPTHMOCAP_API Session {
 public:
  // Throws Error where the models or the options are not fit.
  explicit Session(Recording recording, const SessionOptions& options = {});
  explicit Session(Camera camera, const SessionOptions& options = {});
  ~Session();
  Session(Session&& other) noexcept;
  Session& operator=(Session&& other) noexcept;

  // Of several people the callback is called for each who is there (TrackedFrame::person), or once where nobody is.
  // Tracks, and calls back for each frame, in order, on this thread; what the callback gets is valid during the call
  // only. Throws what the callback throws.
  // A recording: every frame, the same results as `depthmocap replay`. A frame that cannot be read counts as one
  // without measurement; throws Error where no frame can be read. A second run starts anew. A camera: the newest frame;
  // what takes long in the callback costs frames, never delay. Returns when the source ends, `seconds` are over or
  // `stopped` says so.
  void run(const std::function<void(const TrackedFrame&)>& on_frame);
  // The same with the depth frame that was tracked.
  void run(const std::function<void(const TrackedFrame&, const DepthFrame&)>& on_frame);

  // The tracker, for reset(), lockOn() and use() from within the callback.
  [[nodiscard]] Tracker& tracker();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace depthmocap
