#include "libtracker/sensor/capture.h"

#include <algorithm>
#include <utility>

namespace depthmocap {

namespace {
constexpr std::chrono::milliseconds kPatience{50};  // between two looks at whether to stop
}

Capture::Capture(DepthSource& source, Consumer consumer, std::function<void()> ended, double seconds)
    : source_(source), consumer_(std::move(consumer)), ended_(std::move(ended)), seconds_(seconds), thread_([this] {
        run();
      }) {}

Capture::~Capture() {
  stopping_ = true;
  if (thread_.joinable()) thread_.join();
}

void Capture::stop() {
  stopping_ = true;
  if (thread_.joinable()) thread_.join();
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

CaptureStatus Capture::status() const {
  const std::lock_guard lock(mutex_);
  return status_;
}

void Capture::run() {
  try {
    SensorFrame frame;
    while (!stopping_ && step(frame)) continue;
  } catch (...) {
    failure_ = std::current_exception();
  }
  ended_();
}

bool Capture::step(SensorFrame& frame) {
  const SourceState state = source_.next(frame, kPatience);
  if (state == SourceState::Frame) {
    if (seconds_ > 0 && frame.depth.time_s >= seconds_) return false;
    count(frame);
    return consumer_(frame);
  }
  const std::lock_guard lock(mutex_);
  status_.returns = source_.returns();
  if (state == SourceState::Damaged) {
    ++status_.damaged;
    ++damaged_in_gap_;
  }
  if (state == SourceState::Lost) status_.connected = false;
  if (state == SourceState::Damaged || state == SourceState::Lost) status_.problem = source_.problem();
  return state != SourceState::Ended;
}

void Capture::count(const SensorFrame& frame) {
  const std::lock_guard lock(mutex_);
  ++status_.received;
  const std::int64_t gap = frame.depth.frame - last_number_ - 1;
  status_.missing += std::max<std::int64_t>(gap - damaged_in_gap_, 0);
  last_number_ = frame.depth.frame;
  damaged_in_gap_ = 0;
  status_.connected = true;
  status_.returns = source_.returns();
}

}  // namespace depthmocap
