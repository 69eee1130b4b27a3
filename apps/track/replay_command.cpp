#include <CLI/CLI.hpp>
#include <chrono>
#include <iostream>
#include <memory>
#include <optional>
#include <thread>

#include "apps/commands.h"
#include "apps/terminal/progress.h"
#include "apps/terminal/stop_request.h"
#include "apps/terminal/warnings.h"
#include "apps/track/page_tracking.h"
#include "apps/track/recording_run.h"
#include "apps/track/replay_folder.h"
#include "apps/track/seen_depth.h"
#include "apps/track/tracker_setup.h"
#include "apps/track/turn_trial.h"
#include "apps/view/replay_view.h"
#include "depthmocap/error.h"

namespace depthmocap {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

// Programs that show the motion while it is tracked want it at the pace of the recording.
class Pace : public FrameSink {
 public:
  void onFrame(const SessionFrame& frame) override {
    if (!started_) first_s_ = frame.tracked.time_s;
    started_ = true;
    std::this_thread::sleep_until(start_ + std::chrono::duration<double>(frame.tracked.time_s - first_s_));
  }

 private:
  Clock::time_point start_ = Clock::now();
  bool started_ = false;
  double first_s_ = 0;
};

// Where the joints go if no output was asked for: into the folder of work, named like the recording.
fs::path jointsBeside(const fs::path& recording) {
  const fs::path plain = fs::absolute(recording).lexically_normal();
  const fs::path named = plain.has_filename() ? plain : plain.parent_path();
  fs::path joints = named.stem().string() + ".joints.csv";
  std::cerr << "no output was asked for: writing the joints to " << joints.string()
            << " (also --bvh, --gltf, --preview, --view: see depthmocap replay --help)\n";
  return joints;
}

// Many recordings at once have files of fixed names in a folder.
void replayAll(const ReplayOptions& o, const fs::path& out) {
  if (!asksForNothing(o.track)) {
    throw CLI::ValidationError("--out", "names its files itself; leave out --joints, --bvh and the other outputs");
  }
  OutputCheck check;
  check.reads(o.recording);
  check.writesFolder("--out", out);
  checkTrackOptions(check, o.track);
  replayFolder(o, out);
}

// Until Ctrl-C.
void stayForView(ReplayView& view) {
  view.tracked();
  std::cerr << "the page stays until Ctrl-C\n";
  while (!StopRequest::made()) std::this_thread::sleep_for(std::chrono::milliseconds(100));
}

void replay(const ReplayOptions& o) {
  OutputCheck check;
  check.readsRecording(o.recording.string());
  check.reads(o.correction.camera_file);
  checkTrackOptions(check, o.track);
  const auto start = Clock::now();
  const StopRequest on_ctrl_c;
  const RecordingCorrection correction = o.correction.read();
  const Models models = loadModels(o.track);
  RecordingRun run(o, models, correction);
  warn(run.reader->info().guesses);
  ReplaySession& session = run.session;
  Pace pace;
  PageTracking recordings(o, models);
  std::optional<ReplayView> view;
  if (!o.track.vmc.empty() || !o.track.osc_trackers.empty()) session.addSink(pace);
  session.addSink(run.outputs);
  SeenDepth seen;
  session.addSink(seen);
  TurnTrial trial;
  session.addSink(trial);
  if (o.track.view.on) {
    session.addSink(view.emplace(o.track.view, NamedRecording{o.recording, correction}, session.frameCount(),
                                 o.track.people, recordings));
  }
  {
    Progress progress("tracking", session.frameCount());
    session.run({[&](std::size_t done, std::size_t) { progress.update(done); },
                 [](const std::string& message) { warn(message); }, [] { return StopRequest::made(); }});
  }
  run.outputs.finish();
  const RunStats& stats = session.stats();
  if (!o.track.stats.empty()) stats.write(o.track.stats, millisecondsSince(start) / 1000.0, o.track.actor.empty());
  const auto turn = [&] {
    return trial.turnThatHelps(models, run.reader->info().camera, run.config, correction.turn_deg);
  };
  std::cerr << trackedText(stats.tracked(), stats.frames(), seen, turn) << '\n';
  if (view) stayForView(*view);
}

}  // namespace

void addReplayCommand(CLI::App& app) {
  CLI::App* command = app.add_subcommand("replay", "Tracks a recording and writes the motion.");
  const auto options = std::make_shared<ReplayOptions>();
  command
      ->add_option("recording", options->recording,
                   "Recording: a depthmocap or TUM RGB-D folder, or an .oni file; with --out a folder of recordings")
      ->type_name("REC")
      ->required();
  addTrackOptions(*command, options->track);
  const auto out = std::make_shared<fs::path>();
  command
      ->add_option(
          "--out", *out,
          "Tracks all recordings below REC, --threads at the same time, into this folder: joints, pose, angles, "
          "BVH and a summary; what is done there already is left")
      ->type_name("DIR")
      ->group("Outputs");
  addLookAheadOption(*command, options->session.look_ahead_s);
  command
      ->add_option("--passes", options->session.passes,
                   "2: the bodies of people without --actor are fitted over the first seconds, then all is tracked; 1: "
                   "they are fitted while tracking, as live does")
      ->check(CLI::Range(1, 2))
      ->capture_default_str();
  addCorrectionOptions(*command, options->correction);
  command->add_option("--first", options->session.first_frame, "First frame number to track");
  command->add_option("--last", options->session.last_frame, "Last frame number to track");
  command->footer(
      "The same recording gives the same files, byte for byte, for any number of threads.\n"
      "Example:\n"
      "  depthmocap replay recordings/walk --bvh walk.bvh --joints joints.csv --preview walk.mp4\n"
      "  depthmocap replay recordings --out results");
  command->callback([options, out] {
    if (!out->empty()) return replayAll(*options, *out);
    if (asksForNothing(options->track)) options->track.joints = jointsBeside(options->recording);
    replay(*options);
  });
}

}  // namespace depthmocap
