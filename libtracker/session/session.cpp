#include "depthmocap/session.h"

#include <utility>

#include "libtracker/core/config_fields.h"
#include "libtracker/session/live_session.h"
#include "libtracker/session/replay_session.h"
#include "libtracker/tracker/tracker_config.h"

namespace depthmocap {
namespace {

constexpr double kMostLookAhead_s = 1.0;

void validate(const SessionOptions& o) {
  const auto check = [](bool holds, const char* field, double value, const char* rule) {
    checkConfig(holds, "SessionOptions", field, value, rule);
  };
  const double look_ahead_s = o.look_ahead_s.value_or(kLookAhead_s);
  check(look_ahead_s >= 0 && look_ahead_s <= kMostLookAhead_s, "look_ahead_s", look_ahead_s, "from 0 to 1");
  check(o.smooth >= 0 && o.smooth <= 1, "smooth", o.smooth, "from 0 to 1");
  check(o.passes == 1 || o.passes == 2, "passes", o.passes, "1 or 2");
  check(o.seconds >= 0, "seconds", o.seconds, "at least 0");
}

Tracker makeTracker(const CameraModel& camera, const SessionOptions& options) {
  validate(options);
  TrackerConfig config;
  config.threads = options.threads;
  config.people = options.people;
  std::optional<Actor> actor;
  if (options.actor) actor = asSeen(*options.actor);
  return {options.models ? *options.models : Models::shipped(), camera, config, actor};
}

class Callback : public FrameSink {
 public:
  explicit Callback(const std::function<void(const TrackedFrame&, const DepthFrame&)>& call) : call_(call) {}
  void onFrame(const SessionFrame& frame) override {
    bool anybody = false;
    for (const TrackedFrame* person : frame.people) {
      if (person->state == TrackState::Lost) continue;
      anybody = true;
      call_(*person, frame.depth);
    }
    if (!anybody) call_(frame.tracked, frame.depth);
  }

 private:
  const std::function<void(const TrackedFrame&, const DepthFrame&)>& call_;
};

}  // namespace

// Either of a recording or of a camera.
struct Session::Impl {
  Impl(std::unique_ptr<RecordingReader> r, SessionOptions o)
      : reader(std::move(r)), options(std::move(o)), tracker(makeTracker(reader->info().camera, options)) {}
  Impl(std::unique_ptr<DepthSource> s, SessionOptions o)
      : source(std::move(s)), options(std::move(o)), tracker(makeTracker(source->info().camera, options)) {}

  void replay(FrameSink& sink) {
    if (has_run) tracker.reset();
    has_run = true;
    ReplaySessionOptions o;
    o.look_ahead_s = options.look_ahead_s.value_or(kLookAhead_s);
    o.smooth = options.smooth;
    o.passes = options.passes;
    ReplaySession session(*reader, tracker, o);
    session.addSink(sink);
    session.run({{}, options.warn, options.stopped});
  }

  void live(FrameSink& sink) {
    LiveSession session(*source, tracker, nullptr, {options.seconds, options.smooth});
    session.addSink(sink);
    session.run(options.stopped);
  }

  std::unique_ptr<RecordingReader> reader;
  std::unique_ptr<DepthSource> source;
  SessionOptions options;
  Tracker tracker;
  bool has_run = false;
};

Session::Session(Recording recording, const SessionOptions& options)
    : impl_(std::make_unique<Impl>(std::move(recording.reader_), options)) {}
Session::Session(Camera camera, const SessionOptions& options)
    : impl_(std::make_unique<Impl>(std::move(camera.source_), options)) {}
Session::~Session() = default;
Session::Session(Session&&) noexcept = default;
Session& Session::operator=(Session&&) noexcept = default;

void Session::run(const std::function<void(const TrackedFrame&)>& on_frame) {
  run([&on_frame](const TrackedFrame& tracked, const DepthFrame&) { on_frame(tracked); });
}

void Session::run(const std::function<void(const TrackedFrame&, const DepthFrame&)>& on_frame) {
  Callback sink(on_frame);
  impl_->reader ? impl_->replay(sink) : impl_->live(sink);
}

Tracker& Session::tracker() {
  return impl_->tracker;
}

}  // namespace depthmocap
