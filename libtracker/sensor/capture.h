#pragma once
#include <atomic>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "libtracker/sensor/depth_source.h"

namespace depthmocap {

// What came from a source so far.
struct CaptureStatus {
  std::int64_t received = 0;
  std::int64_t missing = 0;  // taken by the sensor, but lost on the way: gaps in the frame numbers
  std::int64_t damaged = 0;
  std::int64_t returns = 0;  // times the camera was lost and found again
  bool connected = true;     // false: the camera is gone, and looked for
  std::string problem;       // the last one of the source; empty: there was none
};

// Reads a source on a thread of its own, so that no frame waits while another is worked on.
class Capture {
 public:
  // Called on the capture thread with each frame; may keep the frame's memory by swapping. False ends the capture.
  using Consumer = std::function<bool(SensorFrame& frame)>;

  // The source must outlive the capture. `ended` is called on the capture thread when nothing more will come. Frames
  // of `seconds` (0: all) are taken, by the sensor's time.
  Capture(DepthSource& source, Consumer consumer, std::function<void()> ended, double seconds = 0);
  ~Capture();  // stops
  Capture(const Capture&) = delete;
  Capture& operator=(const Capture&) = delete;

  // Ends the capture after the frame in hand. Rethrows what the source or the consumer threw, once.
  void stop();
  [[nodiscard]] CaptureStatus status() const;

 private:
  void run();
  bool step(SensorFrame& frame);
  void count(const SensorFrame& frame);

  DepthSource& source_;
  Consumer consumer_;
  std::function<void()> ended_;
  double seconds_;
  mutable std::mutex mutex_;
  CaptureStatus status_;
  std::int64_t last_number_ = -1;
  std::int64_t damaged_in_gap_ = 0;  // since frame last_number_; they are counted as damaged, not as missing
  std::exception_ptr failure_;
  std::atomic<bool> stopping_{false};
  std::thread thread_;  // last: it uses all others
};

}  // namespace depthmocap
