#pragma once
#include <algorithm>

#include "libtracker/sensor/depth_source.h"

namespace depthmocap {

// When, on this computer's clock, a sensor took a frame, from the sensor's own time stamps. The two clocks differ by an
// unknown constant and drift apart slowly. A frame arrives some time after it was taken, so the smallest difference
// seen bounds the constant; what is left is the shortest time that a frame ever was on its way, which nobody can see
// from here.
class SensorClockMap {
 public:
  // `sensor_s` grows. The result is never later than `arrived`.
  SensorClock::time_point taken(double sensor_s, SensorClock::time_point arrived) {
    const double arrived_s = std::chrono::duration<double>(arrived.time_since_epoch()).count();
    const double offset_s = arrived_s - sensor_s;
    offset_s_ = seen_ ? std::min(offset_s, offset_s_ + kFastestDrift * (arrived_s - last_arrived_s_)) : offset_s;
    seen_ = true;
    last_arrived_s_ = arrived_s;
    return arrived -
           std::chrono::duration_cast<SensorClock::duration>(std::chrono::duration<double>(offset_s - offset_s_));
  }

 private:
  static constexpr double kFastestDrift = 1e-4;  // [s/s] of a cheap quartz
  bool seen_ = false;
  double offset_s_ = 0;
  double last_arrived_s_ = 0;
};

}  // namespace depthmocap
