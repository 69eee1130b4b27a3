#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdint>
#include <iostream>
#include <limits>
#include <memory>
#include <optional>
#include <thread>

#include "apps/commands.h"
#include "apps/progress.h"
#include "apps/run_stats.h"
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
    if (!first_s_) first_s_ = time_s;
    std::this_thread::sleep_until(start_ + std::chrono::duration<double>(time_s - *first_s_));
  }

 private:
  bool on_;
  Clock::time_point start_ = Clock::now();
  std::optional<double> first_s_;
};

void replay(const ReplayOptions& options) {
  const auto start = Clock::now();
  const std::unique_ptr<RecordingReader> reader = openRecording(options.recording);
  Tracker tracker(loadTrackerModels(options.track), reader->info().camera, trackerConfig(options.track));
  TrackOutputs outputs(options.track, reader->info());
  RunStats stats;
  Pace pace(!options.track.vmc.empty());
  std::size_t readable = 0;
  DepthFrame frame;
  {
    Progress progress("tracking", reader->frameCount());
    for (std::size_t i = 0; i < reader->frameCount(); ++i) {
      if (reader->frameNumber(i) < options.first || reader->frameNumber(i) > options.last) continue;
      readable += readFrame(*reader, i, frame, stats) ? 1 : 0;
      const TrackedFrame& tracked = tracker.process(frame);
      stats.addFrame(tracked);
      pace.waitFor(frame.time_s);
      const auto write_start = Clock::now();
      outputs.write(frame, tracked);
      stats.addWrite(millisecondsSince(write_start));
      progress.update(i + 1);
    }
  }
  if (stats.frames() == 0) throw Error("no frame between --first and --last", options.recording.string());
  if (readable == 0) throw Error("no frame of the recording can be read", options.recording.string());
  outputs.finish(tracker.actor());
  const double wall_s = millisecondsSince(start) / 1000.0;
  if (!options.track.stats.empty()) stats.write(options.track.stats, wall_s, true);
  std::cerr << "tracked " << stats.tracked() << " of " << stats.frames() << " frames\n";
}

}  // namespace

void addReplayCommand(CLI::App& app) {
  CLI::App* command = app.add_subcommand("replay", "Tracks a recording and writes the motion.");
  const auto options = std::make_shared<ReplayOptions>();
  command->add_option("recording", options->recording, "Recording: a depthmocap or TUM RGB-D folder")
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
