#include "libtracker/session/replay_session.h"

#include "depthmocap/error.h"
#include "libtracker/session/body_pass.h"
#include "libtracker/tracker/fitted_body.h"

namespace depthmocap {

ReplaySession::ReplaySession(RecordingReader& reader, Tracker& tracker, const ReplaySessionOptions& options)
    : reader_(reader),
      tracker_(tracker),
      options_(options),
      pipeline_(tracker, options.look_ahead_s, options.smooth, stats_) {
  for (std::size_t i = 0; i < reader.frameCount() && chosen_.size() < options.most_frames; ++i) {
    const std::int64_t number = reader.frameNumber(i);
    if (number >= options.first_frame && number <= options.last_frame) chosen_.push_back(i);
  }
  if (chosen_.empty()) throw Error("no frame between --first and --last", options_.name);
}

void ReplaySession::run(const ReplayHooks& hooks) {
  const std::size_t before = fitFirst(hooks);
  std::size_t readable = 0;
  std::size_t done = 0;
  for (; done < chosen_.size() && !(hooks.stopped && hooks.stopped()); ++done) {
    readable += read(chosen_[done]) ? 1 : 0;
    pipeline_.process(chosen_[done], frame_);
    if (hooks.progress) hooks.progress(before + done + 1, before + chosen_.size());
  }
  if (hooks.warn) {
    for (const std::string& line : unreadable_.lines("counted as empty")) hooks.warn(line);
  }
  if (readable == 0 && done == chosen_.size()) throw Error("no frame of the recording can be read", options_.name);
  pipeline_.finish();
}

// The frames that were read for the bodies.
std::size_t ReplaySession::fitFirst(const ReplayHooks& hooks) {
  if (options_.passes < 2 || !FittedBody::isWanted(tracker_)) return 0;
  std::size_t read = 0;
  const auto progress = [&](std::size_t done, std::size_t total) {
    read = total;
    if (hooks.progress) hooks.progress(done, total + chosen_.size());
  };
  fitBodies(reader_, tracker_, options_, {progress, {}, hooks.stopped});
  return read;
}

bool ReplaySession::read(std::size_t i) {
  const auto start = RateMeter::Clock::now();
  try {
    reader_.read(i, frame_);
  } catch (const Error& error) {
    unreadable_.add(error);
    stats_.addUnreadable();
    frame_.frame = reader_.frameNumber(i);
    frame_.time_s = reader_.time(i);
    frame_.depth.reset(reader_.info().camera.width, reader_.info().camera.height, 0.0F);
    return false;
  }
  stats_.addRead(millisecondsSince(start));
  return true;
}

}  // namespace depthmocap
