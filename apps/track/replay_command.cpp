#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdint>
#include <deque>
#include <iostream>
#include <limits>
#include <memory>
#include <optional>
#include <thread>
#include <vector>

#include "apps/commands.h"
#include "apps/terminal/progress.h"
#include "apps/terminal/stop_request.h"
#include "apps/track/look_ahead.h"
#include "apps/track/run_stats.h"
#include "apps/track/track_options.h"
#include "apps/track/track_outputs.h"
#include "apps/track/tracker_setup.h"
#include "apps/view/replay_view.h"
#include "depthmocap/error.h"
#include "depthmocap/tracker.h"
#include "libtracker/recording/recording.h"

namespace depthmocap {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

struct ReplayOptions {
  fs::path recording;
  TrackOptions track;
  double look_ahead_s = kLookAhead_s;
  std::int64_t first = 0;
  std::int64_t last = std::numeric_limits<std::int64_t>::max();
};

double millisecondsSince(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

// A frame that cannot be read is a frame without measurement: the tracker coasts over it or loses the actor, and the
// rest of the recording is still tracked.
bool readFrame(RecordingReader& reader, std::size_t i, DepthFrame& frame, RunStats& stats) {
  const auto start = Clock::now();
  try {
    reader.read(i, frame);
  } catch (const Error& error) {
    std::cerr << "depthmocap: warning: " << error.what() << "; frame counted as empty\n";
    stats.addUnreadable();
    frame.frame = reader.frameNumber(i);
    frame.time_s = reader.time(i);
    frame.depth.reset(reader.info().camera.width, reader.info().camera.height, 0.0F);
    return false;
  }
  stats.addRead(millisecondsSince(start));
  return true;
}

// Programs that show the motion while it is tracked want it at the pace of the recording.
class Pace {
 public:
  explicit Pace(bool on) : on_(on) {}
  void waitFor(double time_s) {
    if (!on_) return;
    if (!started_) first_s_ = time_s;
    started_ = true;
    std::this_thread::sleep_until(start_ + std::chrono::duration<double>(time_s - first_s_));
  }

 private:
  bool on_;
  Clock::time_point start_ = Clock::now();
  bool started_ = false;
  double first_s_ = 0;
};

// Rate of the tracker over the last frames.
class FrameRate {
 public:
  void count() {
    times_.push_back(Clock::now());
    if (times_.size() > kFrames) times_.pop_front();
  }
  [[nodiscard]] double perSecond() const {
    const double span_s = std::chrono::duration<double>(times_.back() - times_.front()).count();
    return span_s > 0 ? static_cast<double>(times_.size() - 1) / span_s : 0.0;
  }

 private:
  static constexpr std::size_t kFrames = 30;
  std::deque<Clock::time_point> times_;
};

// Indices of the frames to track.
std::vector<std::size_t> chosenFrames(const RecordingReader& reader, const ReplayOptions& options) {
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < reader.frameCount(); ++i) {
    if (reader.frameNumber(i) >= options.first && reader.frameNumber(i) <= options.last) chosen.push_back(i);
  }
  if (chosen.empty()) throw Error("no frame between --first and --last", options.recording.string());
  return chosen;
}

// Where tracked frames go: files, streams and the page.
class ReplayOutputs {
 public:
  ReplayOutputs(const ReplayOptions& options, const RecordingInfo& info, std::size_t total)
      : outputs_(options.track, info), pace_(!options.track.vmc.empty()) {
    if (options.track.view.on) view_.emplace(options.track.view, options.recording, total);
  }
  // Every frame that has waited long enough.
  void take(LookAhead& waiting, RunStats& stats) {
    while (const LookAhead::Frame* frame = waiting.next()) {
      pace_.waitFor(frame->tracked.time_s);
      const auto start = Clock::now();
      const TrackedFrame& shown = outputs_.write(frame->depth, frame->tracked);
      if (view_) view_->add(frame->index, shown, rate_.perSecond());
      stats.addWrite(millisecondsSince(start));
    }
  }
  void countTracked() { rate_.count(); }
  void finish(const Actor& actor) { outputs_.finish(actor); }
  // Until Ctrl-C.
  void stayForView() {
    if (!view_) return;
    view_->tracked();
    std::cerr << "the page stays until Ctrl-C\n";
    while (!StopRequest::made()) std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }

 private:
  TrackOutputs outputs_;
  std::optional<ReplayView> view_;
  Pace pace_;
  FrameRate rate_;
};

void replay(const ReplayOptions& options) {
  const auto start = Clock::now();
  const StopRequest on_ctrl_c;
  const std::unique_ptr<RecordingReader> reader = openRecording(options.recording);
  const std::vector<std::size_t> chosen = chosenFrames(*reader, options);
  Tracker tracker(loadModels(options.track), reader->info().camera, trackerConfig(options.track),
                  actorOf(options.track));
  ReplayOutputs outputs(options, reader->info(), chosen.size());
  LookAhead waiting(options.look_ahead_s);
  RunStats stats;
  std::size_t readable = 0;
  DepthFrame frame;
  {
    Progress progress("tracking", chosen.size());
    for (std::size_t n = 0; n < chosen.size() && !StopRequest::made(); ++n) {
      readable += readFrame(*reader, chosen[n], frame, stats) ? 1 : 0;
      const TrackedFrame& tracked = tracker.process(frame);
      stats.addFrame(tracked);
      outputs.countTracked();
      waiting.add(chosen[n], frame, tracked, tracker.actor());
      outputs.take(waiting, stats);
      progress.update(n + 1);
    }
  }
  if (readable == 0 && !StopRequest::made())
    throw Error("no frame of the recording can be read", options.recording.string());
  waiting.finish();
  outputs.take(waiting, stats);
  outputs.finish(tracker.actor());
  const double wall_s = millisecondsSince(start) / 1000.0;
  if (!options.track.stats.empty()) stats.write(options.track.stats, wall_s, options.track.actor.empty());
  std::cerr << "tracked " << stats.tracked() << " of " << stats.frames() << " frames\n";
  outputs.stayForView();
}

}  // namespace

void addReplayCommand(CLI::App& app) {
  CLI::App* command = app.add_subcommand("replay", "Tracks a recording and writes the motion.");
  const auto options = std::make_shared<ReplayOptions>();
  command->add_option("recording", options->recording, "Recording: a depthmocap or TUM RGB-D folder, or an .oni file")
      ->type_name("REC")
      ->required();
  addTrackOptions(*command, options->track);
  addLookAheadOption(*command, options->look_ahead_s);
  command->add_option("--first", options->first, "First frame number to track");
  command->add_option("--last", options->last, "Last frame number to track");
  command->footer(
      "The same recording gives the same files, byte for byte, for any number of threads.\n"
      "Example:\n"
      "  depthmocap replay recordings/walk --bvh walk.bvh --joints joints.csv --preview walk.mp4");
  command->callback([options] { replay(*options); });
}

}  // namespace depthmocap
