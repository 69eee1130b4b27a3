#pragma once
#include <chrono>
#include <cstdint>
#include <string>

#include "depthmocap/camera.h"
#include "depthmocap/depth_frame.h"
#include "libtracker/recording/recording.h"

namespace depthmocap {

using SensorClock = std::chrono::steady_clock;

// One picture of a source, with what only a source knows about it.
struct SensorFrame {
  // Numbers count what the sensor took, from 0: a number that is missing was lost before it came here. Times are the
  // sensor's own, from 0 [s]. Both grow over an unplugged cable, too.
  DepthFrame depth;
  SensorClock::time_point taken;  // when the sensor took it, on this computer's clock; never later than now
};

// A live camera, or a recording that behaves as one. Used by one thread at a time.
class DepthSource {
 public:
  virtual ~DepthSource() = default;
  // The frames' camera, without distortion; rate; unit of the sensor's depth steps. Constant.
  [[nodiscard]] virtual const RecordingInfo& info() const = 0;
  // Waits at most `timeout` for the next frame. `frame`, whose memory is reused, is changed with Frame only.
  virtual SourceState next(SensorFrame& frame, std::chrono::milliseconds timeout) = 0;
  // Why the source is damaged or lost, for people.
  [[nodiscard]] virtual std::string problem() const { return {}; }
  // True where frames wait to be read: being slow loses none, so nobody need drop any.
  [[nodiscard]] virtual bool waitsForReader() const { return false; }
  // How often the camera was lost and found again.
  [[nodiscard]] virtual std::int64_t returns() const { return 0; }
};

}  // namespace depthmocap
