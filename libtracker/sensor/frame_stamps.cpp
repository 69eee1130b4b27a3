#include "libtracker/sensor/frame_stamps.h"

#include <algorithm>
#include <utility>

namespace depthmocap {

void FrameStamps::stamp(const SensorStamp& stamp, double fps, SensorFrame& frame) {
  const SensorClock::time_point arrived = SensorClock::now();
  if (std::exchange(first_, false)) {
    first_count_ = stamp.count;
    first_time_s_ = stamp.time_s;
  }
  const std::int64_t number = stamp.count - first_count_;
  double time_s = stamp.time_s - first_time_s_;
  const bool timed = last_number_ < 0 || time_s > last_time_s_;
  if (!timed) time_s = last_time_s_ + 1.0 / fps;
  const SensorClock::time_point stamped(
      std::chrono::duration_cast<SensorClock::duration>(std::chrono::duration<double>(stamp.time_s)));
  frame.taken = stamp.on_our_clock && timed ? std::min(stamped, arrived) : clock_.taken(time_s, arrived);
  frame.depth.frame = std::max(number, last_number_ + 1);
  frame.depth.time_s = time_s;
  last_number_ = frame.depth.frame;
  last_time_s_ = time_s;
}

}  // namespace depthmocap
