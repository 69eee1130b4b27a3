#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include <fmt/format.h>

#include "apps/commands.h"
#include "apps/terminal/status_line.h"
#include "apps/terminal/stop_request.h"
#include "apps/track/camera_watch.h"
#include "apps/track/page_tracking.h"
#include "apps/track/seen_depth.h"
#include "apps/track/source_options.h"
#include "apps/track/start_page.h"
#include "apps/track/track_options.h"
#include "apps/track/track_outputs.h"
#include "apps/track/tracker_setup.h"
#include "apps/track/turn_trial.h"
#include "apps/view/live_view.h"
#include "depthmocap/error.h"
#include "libtracker/sensor/driver_table.h"
#include "libtracker/session/live_session.h"

namespace depthmocap {
namespace {

namespace fs = std::filesystem;

struct LiveOptions {
  SourceChoice source;
  TrackOptions track;
  fs::path record;
};

std::string statusText(const SessionStatus& s) {
  std::string text = s.camera.connected ? std::string(trackStateName(s.state)) : "no camera";
  text +=
      fmt::format("  {:.0f} fps  latency {:.0f} ms  frames {}  skipped {}", s.fps, s.latency_ms, s.tracked, s.replaced);
  if (s.camera.missing > 0) text += fmt::format("  missing {}", s.camera.missing);
  if (s.recording.written > 0) text += fmt::format("  recorded {}", s.recording.written);
  if (s.recording.dropped > 0) text += fmt::format("  not recorded {}", s.recording.dropped);
  return text;
}

// The line in the terminal.
class TerminalSink : public FrameSink {
 public:
  void onFrame(const SessionFrame&) override {}
  void onStatus(const SessionStatus& status) override {
    watch_.report(status.camera, line_);
    watch_.report(status.recording, line_);
    if (line_.due()) line_.show(statusText(status));
  }

 private:
  StatusLine line_;
  CameraWatch watch_;
};

std::string summaryText(const LiveFigures& f, const RunStats& stats, const SeenDepth& seen,
                        const TurnSearch& turn_that_helps) {
  std::string text = fmt::format("tracked {} of {} frames; skipped {} for newer ones, {} did not arrive",
                                 stats.tracked(), f.received, f.replaced, f.missing);
  if (f.damaged > 0) text += fmt::format(", {} were damaged", f.damaged);
  if (f.returns > 0) text += fmt::format("; the camera came back {} times", f.returns);
  if (f.recorded + f.not_recorded > 0)
    text += fmt::format("; recorded {}, not recorded {}", f.recorded, f.not_recorded);
  if (stats.tracked() == 0 && stats.frames() > 0) text += "; " + seen.explanation(turn_that_helps);
  text += lyingText(seen);
  return text;
}

// Recordings on the page are tracked beside the camera's frames, on one thread that gives way to them.
ReplayOptions replayOptions(const LiveOptions& options) {
  ReplayOptions replay;
  replay.track = options.track;
  replay.track.threads = 1;
  return replay;
}

// What a run owns, in the order in which it has to come up.
struct LiveRun {
  explicit LiveRun(const LiveOptions& options)
      : source(openChosenSource(options.source)),
        models(loadModels(options.track)),
        tracker(models, source->info().camera, trackerConfig(options.track), actorOf(options.track)),
        outputs(options.track, source->info()),
        recordings(replayOptions(options), models) {
    if (!options.record.empty()) recorder.emplace(options.record, source->info(), source->waitsForReader());
    session.emplace(*source, tracker, recorder ? &*recorder : nullptr,
                    LiveSessionOptions{options.source.seconds, options.track.smooth});
    session->addSink(outputs);
    if (options.track.view.on) {
      session->addSink(view.emplace(options.track.view, options.source.source, source->info(), models,
                                    options.track.threads, tracker, recordings));
    }
    session->addSink(terminal);
    session->addSink(seen);
    session->addSink(trial);
  }
  std::unique_ptr<DepthSource> source;
  Models models;
  Tracker tracker;
  TrackOutputs outputs;
  std::optional<Recorder> recorder;
  PageTracking recordings;
  std::optional<LiveView> view;
  TerminalSink terminal;
  SeenDepth seen;
  TurnTrial trial;
  std::optional<LiveSession> session;
};

// Every file is completed, whichever fails first; the first failure is the command's.
void finish(LiveRun& run, LiveFigures& figures, const LiveOptions& options, double wall_s) {
  std::exception_ptr failure;
  const auto attempt = [&failure](const auto& action) {
    try {
      action();
    } catch (const Error&) {
      if (!failure) failure = std::current_exception();
    }
  };
  if (run.recorder) {
    attempt([&] { run.recorder->finish(figures.missing); });
    figures.recorded = run.recorder->status().written;
    figures.not_recorded = run.recorder->status().dropped;
  }
  const auto turn = [&] {
    return run.trial.turnThatHelps(run.models, run.source->info().camera, trackerConfig(options.track),
                                   options.source.correction.turn_deg);
  };
  if (figures.received == 0) attempt([&] { throw Error("not one frame came", options.source.source); });
  if (figures.received > 0) attempt([&] { run.outputs.finish(); });
  run.session->stats().setLive(figures);
  if (!options.track.stats.empty())
    attempt([&] { run.session->stats().write(options.track.stats, wall_s, options.track.actor.empty()); });
  if (failure) std::rethrow_exception(failure);
  std::cerr << summaryText(figures, run.session->stats(), run.seen, turn) << '\n';
}

// Names the first camera that is there; the start page stays until there is one, and while a recording is open on it.
// False after Ctrl-C.
bool waitForCamera(LiveOptions& options) {
  constexpr std::chrono::seconds kLookEvery{3};
  const StopRequest on_ctrl_c;
  const WebServerConfig config = webServerConfig(options.track.view);
  PageTracking tracking(replayOptions(options));
  std::optional<StartPage> start;
  for (auto next = SensorClock::now(); !StopRequest::made();) {
    const bool opened = start && start->page().isOpened();
    const std::vector<FoundCamera> cameras = opened ? std::vector<FoundCamera>{} : cameraDrivers().list();
    if (!cameras.empty()) {
      options.source.source = cameras.front().source;
      return true;
    }
    if (!start) {
      start.emplace(config, options.track.view, StartPage::Cameras::WaitedFor, tracking).page().start();
      // The page that follows has the same address.
      options.track.view.port = start->page().server().port();
      options.track.view.token = config.token;
      std::cerr
          << "no camera yet: plug one in, or open a recording on the page (depthmocap cameras --check says more)\n"
          << "view: " << start->page().server().url() << std::endl;
    }
    next += kLookEvery;
    while (SensorClock::now() < next && !StopRequest::made()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
  }
  return false;
}

void live(const LiveOptions& options) {
  OutputCheck check;
  check.readsRecording(options.source.source);
  check.reads(options.source.correction.camera_file);
  checkTrackOptions(check, options.track);
  check.writesFolder("--record", options.record);
  LiveRun run(options);
  if (asksForNothing(options.track) && options.record.empty()) {
    std::cerr
        << "no output was asked for: nothing is written (--view shows the tracking, --joints, --bvh and others write "
           "it: see depthmocap live --help)\n";
  }
  const StopRequest on_ctrl_c;
  const SensorClock::time_point start = SensorClock::now();
  run.session->run([] { return StopRequest::made(); });
  LiveFigures figures = run.session->figures();
  figures.source = options.source.source;
  finish(run, figures, options, std::chrono::duration<double>(SensorClock::now() - start).count());
}

}  // namespace

void addLiveCommand(CLI::App& app) {
  CLI::App* command = app.add_subcommand("live", "Tracks a camera as it sees, until Ctrl-C.");
  const auto options = std::make_shared<LiveOptions>();
  addSourceOptions(*command, options->source)->required(false);
  command->add_option("--record", options->record, "Folder to record what the camera sees to")->type_name("REC");
  addTrackOptions(*command, options->track);
  command->footer(
      "A frame that comes while the one before is worked on replaces it, if it waits: delay never adds up.\n"
      "A camera that is unplugged is waited for. docs/guide/cameras.md says which cameras work.\n"
      "With --view and no --source the first camera is taken; the page offers recordings until one is plugged in.\n"
      "Example:\n"
      "  depthmocap live --view\n"
      "  depthmocap live --source openni2 --bvh take.bvh --record take\n"
      "  depthmocap live --source replay:recordings/walk --joints joints.csv");
  command->callback([options] {
    const bool named = !options->source.source.empty();
    if (!named && !options->track.view.on) throw CLI::RequiredError("--source (or --view, which waits for a camera)");
    if (named || waitForCamera(*options)) live(*options);
  });
}

}  // namespace depthmocap
