#include "libtracker/session/live_session.h"

#include <chrono>

namespace depthmocap {
namespace {

constexpr std::chrono::milliseconds kPatience{100};     // for a frame, before looking at limits again
constexpr std::chrono::milliseconds kStatusEvery{200};  // for sinks
constexpr double kGrace_s = 1.0;                        // a camera that sends nothing ends a limited run so much later

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

LiveSession::LiveSession(DepthSource& source, Tracker& tracker, Recorder* recorder, const LiveSessionOptions& options)
    : source_(source), recorder_(recorder), options_(options), pipeline_(tracker, 0.0, options.smooth, stats_) {}

void LiveSession::run(const std::function<bool()>& stopped) {
  const SensorClock::time_point start = SensorClock::now();
  const bool limited = options_.seconds > 0 && !source_.waitsForReader();
  capture_ = std::make_unique<Capture>(
      source_, [this](SensorFrame& frame) { return hand(frame); }, [this] { newest_.close(); }, options_.seconds);
  const CloseAtEnd close_at_end(newest_);
  SensorFrame frame;
  while (!newest_.finished() && !(stopped && stopped())) {
    if (newest_.take(frame, kPatience)) track(frame);
    if (SensorClock::now() - last_told_ >= kStatusEvery) tellStatus();
    if (limited && secondsSince(start) > options_.seconds + kGrace_s) break;
  }
  newest_.close();
  capture_->stop();
  pipeline_.finish();
  tellStatus();
  collectFigures();
}

// On the capture thread. The recording gets the frame first: the tracker may keep its memory.
bool LiveSession::hand(SensorFrame& frame) {
  if (recorder_ != nullptr) recorder_->push(frame);
  if (source_.waitsForReader()) return newest_.putWhenTaken(frame);
  newest_.put(frame);
  return true;
}

void LiveSession::track(SensorFrame& frame) {
  status_.state = pipeline_.process(static_cast<std::size_t>(status_.tracked), frame.depth);
  status_.latency_ms = millisecondsSince(frame.taken);
  figures_.latency.add(status_.latency_ms);
  ++status_.tracked;
}

SessionStatus LiveSession::status() {
  SessionStatus status = status_;
  status.camera = capture_->status();
  if (recorder_ != nullptr) status.recording = recorder_->status();
  status.replaced = newest_.replaced();
  status.fps = pipeline_.fps();
  return status;
}

void LiveSession::tellStatus() {
  last_told_ = SensorClock::now();
  pipeline_.tell(status());
}

void LiveSession::collectFigures() {
  const SessionStatus end = status();
  figures_.received = end.camera.received;
  figures_.replaced = end.replaced;
  figures_.missing = end.camera.missing;
  figures_.damaged = end.camera.damaged;
  figures_.returns = end.camera.returns;
}

}  // namespace depthmocap
