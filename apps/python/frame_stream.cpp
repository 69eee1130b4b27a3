#include "apps/python/frame_stream.h"

#include <utility>

namespace depthmocap {

FrameStream::FrameStream(Recording recording, SessionOptions options, std::size_t waiting)
    : most_waiting_(waiting),
      camera_(recording.camera()),
      session_(std::move(recording), heard(std::move(options))),
      thread_([this] { run(); }) {}

FrameStream::FrameStream(Camera camera, SessionOptions options, std::size_t waiting)
    : most_waiting_(waiting),
      camera_(camera.model()),
      session_(std::move(camera), heard(std::move(options))),
      thread_([this] { run(); }) {}

void FrameStream::close() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

SessionOptions FrameStream::heard(SessionOptions options) {
  options.stopped = [this] {
    const std::lock_guard lock(mutex_);
    return stopping_;
  };
  options.warn = [this](const std::string& message) {
    const std::lock_guard lock(mutex_);
    warnings_.push_back(message);
  };
  return options;
}

void FrameStream::run() {
  std::exception_ptr failure;
  try {
    session_.run([this](const TrackedFrame& tracked, const DepthFrame& depth) { keep(tracked, depth); });
  } catch (...) {
    failure = std::current_exception();
  }
  const std::lock_guard lock(mutex_);
  failure_ = failure;
  over_ = true;
  changed_.notify_all();
}

void FrameStream::keep(const TrackedFrame& tracked, const DepthFrame& depth) {
  auto frame = std::make_shared<KeptFrame>(KeptFrame{tracked, depth.depth});
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return stopping_ || frames_.size() < most_waiting_; });
  if (stopping_) return;  // nobody waits for what the session still has in hand
  frames_.push_back(std::move(frame));
  changed_.notify_all();
}

FrameStream::Taken FrameStream::take(std::chrono::milliseconds patience) {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, patience, [this] { return over_ || !frames_.empty(); });
  Taken taken;
  taken.warnings = std::exchange(warnings_, {});
  if (!frames_.empty()) {
    taken.frame = std::move(frames_.front());
    frames_.pop_front();
    changed_.notify_all();
    return taken;
  }
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
  taken.over = over_;
  return taken;
}

}  // namespace depthmocap
