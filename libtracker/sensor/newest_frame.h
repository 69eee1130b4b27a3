#pragma once
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <utility>

#include "libtracker/sensor/depth_source.h"

namespace depthmocap {

// Hands frames from the capture thread to the tracker's: room for one, and the newest wins, so that no queue can grow
// into delay. Frames that were replaced before anybody took them are counted.
class NewestFrame {
 public:
  // Puts `frame` in and gives the memory of an older one back in it.
  void put(SensorFrame& frame) {
    {
      const std::lock_guard lock(mutex_);
      std::swap(frame_, frame);
      replaced_ += full_ ? 1 : 0;
      full_ = true;
    }
    changed_.notify_all();
  }
  // The same for sources that wait: first lets the frame before be taken, so that none is replaced. False when closed.
  bool putWhenTaken(SensorFrame& frame) {
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] { return !full_ || closed_; });
      if (closed_) return false;
    }
    put(frame);
    return true;
  }
  // Takes the newest frame, waiting at most `timeout` for one. False: there is none.
  bool take(SensorFrame& frame, std::chrono::milliseconds timeout) {
    {
      std::unique_lock lock(mutex_);
      changed_.wait_for(lock, timeout, [this] { return full_ || closed_; });
      if (!full_) return false;
      std::swap(frame_, frame);
      full_ = false;
    }
    changed_.notify_all();
    return true;
  }
  // No frame will follow. One that lies here can still be taken.
  void close() {
    {
      const std::lock_guard lock(mutex_);
      closed_ = true;
    }
    changed_.notify_all();
  }
  // Closed, and nothing left to take.
  [[nodiscard]] bool finished() const {
    const std::lock_guard lock(mutex_);
    return closed_ && !full_;
  }
  [[nodiscard]] std::int64_t replaced() const {
    const std::lock_guard lock(mutex_);
    return replaced_;
  }

 private:
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  SensorFrame frame_;
  bool full_ = false;
  bool closed_ = false;
  std::int64_t replaced_ = 0;
};

}  // namespace depthmocap
