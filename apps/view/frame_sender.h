#pragma once
#include <condition_variable>
#include <functional>
#include <mutex>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "apps/view/view_frame.h"

namespace depthmocap {

// Makes the messages of frames, once for all clients, on a background thread: the tracker only leaves a small copy of
// its frame.
class FrameSender {
 public:
  // `deliver` takes a message, on the sender's thread.
  FrameSender(const CameraModel& camera, std::function<void(std::string message)> deliver);
  ~FrameSender();
  FrameSender(const FrameSender&) = delete;
  FrameSender& operator=(const FrameSender&) = delete;

  // Never waits: a frame that is not sent yet is replaced, and one that comes while another is fetched is left out.
  // `depth` at full size; `people`: everybody who may be tracked, by their numbers (>= 1).
  void send(const DepthImage& depth, std::span<const TrackedFrame* const> people, const ViewFigures& figures);

 private:
  struct Job {
    ViewPicture picture;
    std::vector<TrackedFrame> people;
    ViewFigures figures;
  };
  void work();

  ViewFrameEncoder encoder_;
  std::function<void(std::string)> deliver_;
  std::mutex mutex_;
  std::condition_variable changed_;
  Job waiting_;  // guarded by the mutex, as are
  PartImage all_labels_;
  bool waits_ = false;
  bool stop_ = false;
  std::thread thread_;
};

}  // namespace depthmocap
