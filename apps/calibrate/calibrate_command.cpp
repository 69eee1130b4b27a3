#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "apps/calibrate/calibration_picture.h"
#include "apps/commands.h"
#include "apps/terminal/correction_options.h"
#include "apps/terminal/output_check.h"
#include "apps/terminal/progress.h"
#include "apps/terminal/stop_request.h"
#include "apps/terminal/warnings.h"
#include "calibration/calibration_run.h"
#include "calibration/other_frames.h"
#include "depthmocap/error.h"
#include "libtracker/recording/recording.h"
#include "libtracker/recording/unreadable_frames.h"
#include "libtracker/sensor/open_source.h"

namespace depthmocap {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kWait{200};  // for one frame of a camera

struct CalibrateOptions {
  fs::path recording;
  fs::path out;
  fs::path preview;
  fs::path forest;
  fs::path posedb;
  fs::path shape_space;
  bool tpose_only = false;
  CalibratorConfig config;
  double tolerance_deg = 15;
  double seconds = 60;
  CorrectionChoice correction;
};

bool readFrame(RecordingReader& reader, std::size_t i, DepthFrame& frame, UnreadableFrames& unreadable) {
  try {
    reader.read(i, frame);
    return true;
  } catch (const Error& error) {
    unreadable.add(error);
    return false;
  }
}

void collect(RecordingReader& reader, CalibrationRun& run) {
  UnreadableFrames unreadable;
  {
    Progress progress("looking for the T-pose", reader.frameCount());
    DepthFrame frame;
    for (std::size_t i = 0; i < reader.frameCount(); ++i) {
      if (readFrame(reader, i, frame, unreadable)) run.add(frame);
      progress.update(i + 1);
    }
  }
  warn(unreadable.lines("skipped"));
}

// The frames of a recording, for other poses than the T-pose. Those that cannot be read have been told of by collect().
CalibrationRun::Frames othersOf(RecordingReader& reader) {
  return [&reader](const auto& visit) {
    const std::size_t count = std::min(reader.frameCount(), CalibrationRun::kMostOthers);
    Progress progress("looking at other poses", count);
    DepthFrame frame;
    UnreadableFrames told;
    for (std::size_t i = 0; i < count; ++i) {
      if (readFrame(reader, i, frame, told)) visit(frame);
      progress.update(i + 1);
    }
  };
}

// Until enough good frames have come; tells the actor what to change. What the actor does meanwhile may be told from
// the T-pose later.
OtherFrames watch(DepthSource& source, CalibrationRun& run, double limit_s) {
  const StopRequest on_ctrl_c;
  const auto start = SensorClock::now();
  OtherFrames others;
  SensorFrame frame;
  std::string said;
  while (!run.enough() && !StopRequest::made()) {
    if (SensorClock::now() - start > std::chrono::duration<double>(limit_s)) break;
    const SourceState state = source.next(frame, kWait);
    if (state == SourceState::Ended) break;
    if (state != SourceState::Frame) continue;
    others.add(frame.depth);
    const TPoseVerdict verdict = run.add(frame.depth);
    const std::string text = verdict.good() ? "good, hold still" : verdict.advice;
    if (text != said) std::cerr << text << '\n';
    said = text;
  }
  return others;
}

// What a calibration gave.
struct Calibration {
  Actor actor;
  double solve_s = 0;
};

Calibration finish(const CalibrateOptions& o, CalibrationRun& run, const CalibrationRun::Frames& others,
                   const CameraModel& camera) {
  Calibration result{run.solve(others), run.solve_s()};
  if (!o.preview.empty()) writeCalibrationPicture(o.preview, run.shown(), result.actor, camera);
  return result;
}

CalibrationRun newRun(const CalibrateOptions& o, const RecordingInfo& info) {
  CalibrationRunConfig config{o.config, o.tpose_only, info.camera_name};
  const Models models = Models::load(o.forest, o.posedb);
  return {models, loadCalibratorModels(models, o.shape_space), info.camera, config};
}

Calibration calibrateLive(const CalibrateOptions& o) {
  SourceOptions options;
  const RecordingCorrection correction = o.correction.read();
  options.camera = correction.camera;
  options.depth_unit_m = correction.depth_unit_m;
  options.turn_deg = correction.turn_deg;
  const auto source = openSource(o.recording.string(), options);
  warn(source->info().guesses);
  CalibrationRun run = newRun(o, source->info());
  const OtherFrames others = watch(*source, run, o.seconds);
  return finish(o, run, others, source->info().camera);
}

Calibration calibrateRecording(const CalibrateOptions& o) {
  const auto reader = openRecording(o.recording, o.correction.read());
  warn(reader->info().guesses);
  CalibrationRun run = newRun(o, reader->info());
  collect(*reader, run);
  return finish(o, run, othersOf(*reader), reader->info().camera);
}

void calibrate(CalibrateOptions o) {
  OutputCheck check;
  check.readsRecording(o.recording.string());
  check.reads(o.correction.camera_file);
  for (const fs::path& input : {o.forest, o.posedb, o.shape_space}) check.reads(input);
  check.writes("--out", o.out);
  check.writes("--preview", o.preview);
  o.config.check.tolerance_rad = o.tolerance_deg * std::numbers::pi / 180.0;
  const bool is_camera = !fs::exists(o.recording) && checkSourceName(o.recording.string()).empty();
  if (is_camera && o.config.any_pose) {
    throw Error("--any-pose needs a recording", o.recording.string(), "record first, or stand in a T-pose");
  }
  const Calibration result = is_camera ? calibrateLive(o) : calibrateRecording(o);
  writeActorFile(o.out, result.actor);
  const ActorMeasurement::Fit& fit = result.actor.measured->fit;
  std::cerr << fmt::format("a body of {:.3f} m from {} frames of T-pose (solved in {:.2f} s) and {} in other poses; ",
                           result.actor.stature_m(), fit.tpose_frames, result.solve_s, fit.other_frames)
            << fmt::format("surface within {:.1f} mm, confidence {:.2f}\n", 1000 * fit.surface_m, fit.confidence);
}

}  // namespace

void addCalibrateCommand(CLI::App& app) {
  CLI::App* command = app.add_subcommand("calibrate", "Measures an actor who stands in a T-pose.");
  const auto o = std::make_shared<CalibrateOptions>();
  command
      ->add_option("recording", o->recording,
                   "Recording with at least ten frames of T-pose, or a camera as live names it")
      ->type_name("REC-or-SRC")
      ->required();
  addCorrectionOptions(*command, o->correction);
  command->add_option("--out", o->out, "Actor file to write, for replay --actor")->type_name("A.json")->required();
  command->add_option("--preview", o->preview, "Picture of the fitted cylinders over the depth points, PNG")
      ->type_name("P.png");
  command->add_option("--height", o->config.stature_m, "The actor's stature, if known: fixes the scale [m]")
      ->check(CLI::Range(1.0, 2.3));
  command->add_option("--frames", o->config.frames, "Good frames needed and used")
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
  command->add_option("--tolerance", o->tolerance_deg, "How far the arms may be from level and the body turned [deg]")
      ->check(CLI::Range(1.0, 40.0))
      ->capture_default_str();
  command->add_option("--seconds", o->seconds, "A camera: how long to wait for the T-pose")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option("--forest", o->forest, "Body-part classifier that the tracker will use");
  command->add_option("--posedb", o->posedb, "Pose database, for the frames that are no T-pose");
  command->add_flag("--tpose-only", o->tpose_only, "Use nothing but the T-pose, as the paper does");
  command
      ->add_flag("--any-pose", o->config.any_pose,
                 "A recording without a T-pose: measure by whatever poses it shows, less surely")
      ->excludes("--tpose-only")
      ->excludes("--preview");
  command->add_option("--shape-space", o->shape_space, "Statistics of bone lengths");
  command->add_option("--threads", o->config.threads, "Threads; the result does not depend on it")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  command->footer(
      "Example:\n"
      "  depthmocap synthesize --motion procedural:calibrate --out tpose\n"
      "  depthmocap calibrate tpose --out actor.json");
  command->callback([o] { calibrate(*o); });
}

}  // namespace depthmocap
