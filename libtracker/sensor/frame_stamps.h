#pragma once
#include <cstdint>

#include "libtracker/sensor/depth_source.h"
#include "libtracker/sensor/sensor_clock_map.h"

namespace depthmocap {

// What a camera says about a picture of its own accord.
struct SensorStamp {
  std::int64_t count = 0;
  double time_s = 0;          // [s] on a clock that starts anywhere
  bool on_our_clock = false;  // that clock is SensorClock
};

// Numbers and times of frames: from 0, both growing, gaps kept. Cameras that do not count, or whose clock stands still,
// are counted and timed here.
class FrameStamps {
 public:
  // Stamps a frame that has just arrived; `fps` [1/s] of the camera.
  void stamp(const SensorStamp& stamp, double fps, SensorFrame& frame);

 private:
  SensorClockMap clock_;
  bool first_ = true;
  std::int64_t first_count_ = 0;
  double first_time_s_ = 0;
  std::int64_t last_number_ = -1;
  double last_time_s_ = 0;
};

}  // namespace depthmocap
