#include "apps/view/frame_sender.h"

#include <utility>

#include "libtracker/core/background.h"

namespace depthmocap {

FrameSender::FrameSender(const CameraModel& camera, std::function<void(std::string message)> deliver)
    : encoder_(camera), deliver_(std::move(deliver)), thread_([this] { work(); }) {}

FrameSender::~FrameSender() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

void FrameSender::send(const DepthImage& depth, const TrackedFrame& tracked, const ViewFigures& figures) {
  {
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock) return;
    encoder_.pick(depth, tracked.labels, waiting_.picture);
    waiting_.tracked = tracked;
    waiting_.figures = figures;
    waits_ = true;
  }
  changed_.notify_one();
}

void FrameSender::work() {
  runInBackground();
  Job job;
  for (;;) {
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] { return waits_ || stop_; });
      if (stop_) return;
      std::swap(job, waiting_);  // keeps the memory of both
      waits_ = false;
    }
    deliver_(encoder_.encode(job.picture, job.tracked, job.figures));
  }
}

}  // namespace depthmocap
