#include "apps/view/frame_sender.h"

#include <utility>

#include "libtracker/core/background.h"
#include "libtracker/session/people_labels.h"

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

void FrameSender::send(const DepthImage& depth, std::span<const TrackedFrame* const> people,
                       const ViewFigures& figures) {
  {
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock) return;
    encoder_.pick(depth, labelsOfAll(people, kPersonLabelStep, all_labels_), waiting_.picture);
    waiting_.people.resize(people.size());
    for (std::size_t i = 0; i < people.size(); ++i) waiting_.people[i] = *people[i];
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
    deliver_(encoder_.encode(job.picture, job.people, job.figures));
  }
}

}  // namespace depthmocap
