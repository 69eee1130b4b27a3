#include "libtracker/session/replay_session.h"

#include "depthmocap/error.h"

namespace depthmocap {

ReplaySession::ReplaySession(RecordingReader& reader, Tracker& tracker, const ReplaySessionOptions& options)
    : reader_(reader), name_(options.name), pipeline_(tracker, options.look_ahead_s, options.smooth, stats_) {
  for (std::size_t i = 0; i < reader.frameCount() && chosen_.size() < options.most_frames; ++i) {
    const std::int64_t number = reader.frameNumber(i);
    if (number >= options.first_frame && number <= options.last_frame) chosen_.push_back(i);
  }
  if (chosen_.empty()) throw Error("no frame between --first and --last", name_);
}

void ReplaySession::run(const ReplayHooks& hooks) {
  std::size_t readable = 0;
  std::size_t done = 0;
  for (; done < chosen_.size() && !(hooks.stopped && hooks.stopped()); ++done) {
    readable += read(chosen_[done]) ? 1 : 0;
    pipeline_.process(chosen_[done], frame_);
    if (hooks.progress) hooks.progress(done + 1, chosen_.size());
  }
  if (hooks.warn) {
    for (const std::string& line : unreadable_.lines("counted as empty")) hooks.warn(line);
  }
  if (readable == 0 && done == chosen_.size()) throw Error("no frame of the recording can be read", name_);
  pipeline_.finish();
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
