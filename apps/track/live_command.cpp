#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "apps/commands.h"
#include "apps/terminal/status_line.h"
#include "apps/terminal/stop_request.h"
#include "apps/track/camera_watch.h"
#include "apps/track/live_loop.h"
#include "apps/track/run_stats.h"
#include "apps/track/source_options.h"
#include "apps/track/track_options.h"
#include "apps/track/track_outputs.h"
#include "apps/track/tracker_setup.h"
#include "apps/view/live_view.h"
#include "depthmocap/error.h"

namespace depthmocap {
namespace {

namespace fs = std::filesystem;

struct LiveOptions {
  SourceChoice source;
  TrackOptions track;
  fs::path record;
};

// Files, figures and the page of a run.
class OutputSink : public LiveSink {
 public:
  // `view` may be null.
  OutputSink(TrackOutputs& outputs, RunStats& stats, LiveView* view) : outputs_(outputs), stats_(stats), view_(view) {}
  void onFrame(const DepthFrame& frame, const TrackedFrame& tracked) override {
    const SensorClock::time_point start = SensorClock::now();
    stats_.addFrame(tracked);
    const TrackedFrame& shown = outputs_.write(frame, tracked);
    if (view_ != nullptr) view_->onFrame(frame, shown);
    stats_.addWrite(std::chrono::duration<double, std::milli>(SensorClock::now() - start).count());
  }

  void onStatus(const LiveStatus& status) override {
    if (view_ != nullptr) view_->onStatus(status);
  }

 private:
  TrackOutputs& outputs_;
  RunStats& stats_;
  LiveView* view_;
};

std::string statusText(const LiveStatus& s) {
  std::string text = s.camera.connected ? std::string(trackStateName(s.state)) : "no camera";
  text +=
      fmt::format("  {:.0f} fps  latency {:.0f} ms  frames {}  skipped {}", s.fps, s.latency_ms, s.tracked, s.replaced);
  if (s.camera.missing > 0) text += fmt::format("  missing {}", s.camera.missing);
  if (s.recording.written > 0) text += fmt::format("  recorded {}", s.recording.written);
  if (s.recording.dropped > 0) text += fmt::format("  not recorded {}", s.recording.dropped);
  return text;
}

// The line in the terminal.
class TerminalSink : public LiveSink {
 public:
  void onFrame(const DepthFrame&, const TrackedFrame&) override {}
  void onStatus(const LiveStatus& status) override {
    watch_.report(status.camera, line_);
    watch_.report(status.recording, line_);
    if (line_.due()) line_.show(statusText(status));
  }

 private:
  StatusLine line_;
  CameraWatch watch_;
};

std::string summaryText(const LiveFigures& f, const RunStats& stats) {
  std::string text = fmt::format("tracked {} of {} frames; skipped {} for newer ones, {} did not arrive",
                                 stats.tracked(), f.received, f.replaced, f.missing);
  if (f.damaged > 0) text += fmt::format(", {} were damaged", f.damaged);
  if (f.returns > 0) text += fmt::format("; the camera came back {} times", f.returns);
  if (f.recorded + f.not_recorded > 0)
    text += fmt::format("; recorded {}, not recorded {}", f.recorded, f.not_recorded);
  return text;
}

// What a run owns, in the order in which it has to come up.
struct LiveRun {
  explicit LiveRun(const LiveOptions& options)
      : source(openChosenSource(options.source)),
        tracker(loadModels(options.track), source->info().camera, trackerConfig(options.track), actorOf(options.track)),
        outputs(options.track, source->info()) {
    if (!options.record.empty()) recorder.emplace(options.record, source->info(), source->waitsForReader());
    if (options.track.view.on) view.emplace(options.track, options.source.source, source->info(), tracker);
  }
  std::unique_ptr<DepthSource> source;
  Tracker tracker;
  TrackOutputs outputs;
  std::optional<Recorder> recorder;
  std::optional<LiveView> view;
  RunStats stats{Durations::Keep::Binned};
};

LiveFigures track(LiveRun& run, double seconds) {
  LiveLoop loop(*run.source, run.tracker, run.recorder ? &*run.recorder : nullptr);
  OutputSink files(run.outputs, run.stats, run.view ? &*run.view : nullptr);
  TerminalSink terminal;
  loop.addSink(files);
  loop.addSink(terminal);
  loop.run({seconds, [] { return StopRequest::made(); }});
  return loop.figures();
}

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
  std::cerr << summaryText(figures, run.stats) << '\n';
  if (figures.received == 0) attempt([&] { throw Error("not one frame came", options.source.source); });
  if (figures.received > 0) attempt([&] { run.outputs.finish(run.tracker.actor()); });
  run.stats.setLive(figures);
  if (!options.track.stats.empty())
    attempt([&] { run.stats.write(options.track.stats, wall_s, options.track.actor.empty()); });
  if (failure) std::rethrow_exception(failure);
}

void live(const LiveOptions& options) {
  LiveRun run(options);
  const StopRequest on_ctrl_c;
  const SensorClock::time_point start = SensorClock::now();
  LiveFigures figures = track(run, options.source.seconds);
  figures.source = options.source.source;
  finish(run, figures, options, std::chrono::duration<double>(SensorClock::now() - start).count());
}

}  // namespace

void addLiveCommand(CLI::App& app) {
  CLI::App* command = app.add_subcommand("live", "Tracks a camera as it sees, until Ctrl-C.");
  const auto options = std::make_shared<LiveOptions>();
  addSourceOptions(*command, options->source);
  command->add_option("--record", options->record, "Folder to record what the camera sees to")->type_name("REC");
  addTrackOptions(*command, options->track);
  command->footer(
      "A frame that comes while the one before is worked on replaces it, if it waits: delay never adds up.\n"
      "A camera that is unplugged is waited for. docs/cameras.md says which cameras work.\n"
      "Example:\n"
      "  depthmocap live --source openni2 --bvh take.bvh --record take\n"
      "  depthmocap live --source replay:recordings/walk --joints joints.csv");
  command->callback([options] { live(*options); });
}

}  // namespace depthmocap
