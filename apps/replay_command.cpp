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
#include "apps/progress.h"
#include "apps/replay_view.h"
#include "apps/run_stats.h"
#include "apps/stop_request.h"
#include "apps/track_options.h"
#include "apps/track_outputs.h"
#include "apps/tracker_setup.h"
#include "libtracker/core/error.h"
#include "libtracker/recording/recording.h"
#include "libtracker/tracker/tracker.h"

namespace depthmocap {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

struct ReplayOptions {
  fs::path recording;
  TrackOptions track;
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
  // [1/s]
  double next() {
    const Clock::time_point now = Clock::now();
    times_.push_back(now);
    if (times_.size() > kFrames) times_.pop_front();
    const double span_s = std::chrono::duration<double>(now - times_.front()).count();
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

void replay(const ReplayOptions& options) {
  const auto start = Clock::now();
  const StopRequest on_ctrl_c;
  const std::unique_ptr<RecordingReader> reader = openRecording(options.recording);
  const std::vector<std::size_t> chosen = chosenFrames(*reader, options);
  Tracker tracker(loadTrackerModels(options.track), reader->info().camera, trackerConfig(options.track),
                  actorOf(options.track));
  TrackOutputs outputs(options.track, reader->info());
  std::optional<ReplayView> view;
  if (options.track.view.on) view.emplace(options.track.view, options.recording, chosen.size());
  RunStats stats;
  Pace pace(!options.track.vmc.empty());
  FrameRate rate;
  std::size_t readable = 0;
  DepthFrame frame;
  {
    Progress progress("tracking", chosen.size());
    for (std::size_t n = 0; n < chosen.size() && !StopRequest::made(); ++n) {
      readable += readFrame(*reader, chosen[n], frame, stats) ? 1 : 0;
      const TrackedFrame& tracked = tracker.process(frame);
      stats.addFrame(tracked);
      pace.waitFor(frame.time_s);
      const auto write_start = Clock::now();
      const TrackedFrame& shown = outputs.write(frame, tracked);
      if (view) view->add(chosen[n], shown, rate.next());
      stats.addWrite(millisecondsSince(write_start));
      progress.update(n + 1);
    }
  }
  if (readable == 0 && !StopRequest::made())
    throw Error("no frame of the recording can be read", options.recording.string());
  outputs.finish(tracker.actor());
  const double wall_s = millisecondsSince(start) / 1000.0;
  if (!options.track.stats.empty()) stats.write(options.track.stats, wall_s, options.track.actor.empty());
  std::cerr << "tracked " << stats.tracked() << " of " << stats.frames() << " frames\n";
  if (!view) return;
  view->tracked();
  std::cerr << "the page stays until Ctrl-C\n";
  while (!StopRequest::made()) std::this_thread::sleep_for(std::chrono::milliseconds(100));
}

}  // namespace

void addReplayCommand(CLI::App& app) {
  CLI::App* command = app.add_subcommand("replay", "Tracks a recording and writes the motion.");
  const auto options = std::make_shared<ReplayOptions>();
  command->add_option("recording", options->recording, "Recording: a depthmocap or TUM RGB-D folder, or an .oni file")
      ->type_name("REC")
      ->required();
  addTrackOptions(*command, options->track);
  command->add_option("--first", options->first, "First frame number to track");
  command->add_option("--last", options->last, "Last frame number to track");
  command->footer(
      "The same recording gives the same files, byte for byte, for any number of threads.\n"
      "Example:\n"
      "  depthmocap replay recordings/walk --bvh walk.bvh --joints joints.csv --preview walk.mp4");
  command->callback([options] { replay(*options); });
}

}  // namespace depthmocap
