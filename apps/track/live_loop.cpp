#include "apps/track/live_loop.h"

#include <algorithm>

namespace depthmocap {

namespace {

constexpr std::chrono::milliseconds kPatience{100};     // for a frame, before looking at limits again
constexpr std::chrono::milliseconds kStatusEvery{200};  // for sinks
constexpr std::chrono::seconds kRateWindow{1};
constexpr double kGrace_s = 1.0;  // a camera that sends nothing ends a limited run so much later

// However the tracker ends: a capture thread that waits for it must not wait for ever.
class CloseAtEnd {
 public:
  explicit CloseAtEnd(NewestFrame& slot) : slot_(slot) {}
  ~CloseAtEnd() { slot_.close(); }
  CloseAtEnd(const CloseAtEnd&) = delete;
  CloseAtEnd& operator=(const CloseAtEnd&) = delete;

 private:
  NewestFrame& slot_;
};

double secondsSince(SensorClock::time_point start) {
  return std::chrono::duration<double>(SensorClock::now() - start).count();
}

}  // namespace

LiveLoop::LiveLoop(DepthSource& source, Tracker& tracker, Recorder* recorder)
    : source_(source), tracker_(tracker), recorder_(recorder) {}

void LiveLoop::run(const LiveLimits& limits) {
  const SensorClock::time_point start = SensorClock::now();
  const bool limited = limits.seconds > 0 && !source_.waitsForReader();
  capture_ = std::make_unique<Capture>(
      source_, [this](SensorFrame& frame) { return hand(frame); }, [this] { newest_.close(); }, limits.seconds);
  const CloseAtEnd close_at_end(newest_);
  SensorFrame frame;
  while (!newest_.finished() && !(limits.stopped && limits.stopped())) {
    if (newest_.take(frame, kPatience)) track(frame);
    if (SensorClock::now() - last_told_ >= kStatusEvery) tellStatus();
    if (limited && secondsSince(start) > limits.seconds + kGrace_s) break;
  }
  newest_.close();
  capture_->stop();
  tellStatus();
  collectFigures();
}

// On the capture thread. The recording gets the frame first: the tracker may keep its memory.
bool LiveLoop::hand(SensorFrame& frame) {
  if (recorder_ != nullptr) recorder_->push(frame);
  if (source_.waitsForReader()) return newest_.putWhenTaken(frame);
  newest_.put(frame);
  return true;
}

void LiveLoop::track(const SensorFrame& frame) {
  const TrackedFrame& tracked = tracker_.process(frame.depth);
  for (LiveSink* sink : sinks_) sink->onFrame(frame.depth, tracked);
  const SensorClock::time_point now = SensorClock::now();
  status_.latency_ms = std::chrono::duration<double, std::milli>(now - frame.taken).count();
  figures_.latency.add(status_.latency_ms);
  status_.state = tracked.state;
  ++status_.tracked;
  recent_.push_back(now);
  recent_.erase(recent_.begin(),
                std::find_if(recent_.begin(), recent_.end(), [now](auto time) { return now - time <= kRateWindow; }));
}

LiveStatus LiveLoop::status() const {
  LiveStatus status = status_;
  status.camera = capture_->status();
  if (recorder_ != nullptr) status.recording = recorder_->status();
  status.replaced = newest_.replaced();
  const SensorClock::time_point now = SensorClock::now();
  status.fps = static_cast<double>(
      std::count_if(recent_.begin(), recent_.end(), [now](auto time) { return now - time <= kRateWindow; }));
  return status;
}

void LiveLoop::tellStatus() {
  last_told_ = SensorClock::now();
  const LiveStatus now = status();
  for (LiveSink* sink : sinks_) sink->onStatus(now);
}

void LiveLoop::collectFigures() {
  const LiveStatus end = status();
  figures_.received = end.camera.received;
  figures_.replaced = end.replaced;
  figures_.missing = end.camera.missing;
  figures_.damaged = end.camera.damaged;
  figures_.returns = end.camera.returns;
}

}  // namespace depthmocap
