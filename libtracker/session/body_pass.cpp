#include "libtracker/session/body_pass.h"

#include <algorithm>
#include <cmath>

#include "libtracker/tracker/fitted_body.h"

namespace depthmocap {
namespace {

constexpr double kPass_s = 15.0;  // of the recording: TrackPolicy::shape_s and some in which nobody is in view

}  // namespace

void fitBodies(RecordingReader& reader, Tracker& tracker, ReplaySessionOptions options, const ReplayHooks& hooks) {
  options.look_ahead_s = 0;
  options.smooth = 0;
  options.passes = 1;
  options.most_frames = std::min(options.most_frames, static_cast<std::size_t>(std::ceil(kPass_s * reader.info().fps)));
  const auto done = [&] { return (hooks.stopped && hooks.stopped()) || !FittedBody::isWanted(tracker); };
  ReplaySession(reader, tracker, options).run({hooks.progress, {}, done});
  FittedBody::keep(tracker);
  tracker.reset();
}

}  // namespace depthmocap
