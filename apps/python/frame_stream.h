#pragma once
#include <condition_variable>
#include <deque>
#include <exception>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "depthmocap/session.h"

namespace depthmocap {

// One tracked frame that stays.
struct KeptFrame {
  TrackedFrame tracked;
  DepthImage depth;  // [m]
};

// A session on a thread of its own, whose frames are taken one by one. Knows nothing of Python.
class FrameStream {
 public:
  // `waiting`: frames (>= 1) that may wait to be taken; the session waits beyond them.
  FrameStream(Recording recording, SessionOptions options, std::size_t waiting);
  FrameStream(Camera camera, SessionOptions options, std::size_t waiting);
  ~FrameStream() { close(); }
  FrameStream(const FrameStream&) = delete;
  FrameStream& operator=(const FrameStream&) = delete;

  struct Taken {
    std::shared_ptr<KeptFrame> frame;   // null: none yet, or over
    std::vector<std::string> warnings;  // since the last call
    bool over = false;
  };
  // Waits at most `patience`. Throws what the session threw, once all frames are taken.
  Taken take(std::chrono::milliseconds patience);
  // Of the frames' depth, without distortion.
  [[nodiscard]] const CameraModel& camera() const { return camera_; }
  // Ends the session; what waits can still be taken.
  void close();

 private:
  SessionOptions heard(SessionOptions options);
  void run();
  void keep(const TrackedFrame& tracked, const DepthFrame& depth);

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::shared_ptr<KeptFrame>> frames_;
  std::vector<std::string> warnings_;
  std::exception_ptr failure_;
  bool over_ = false;
  bool stopping_ = false;
  const std::size_t most_waiting_;
  const CameraModel camera_;
  Session session_;
  std::thread thread_;
};

}  // namespace depthmocap
