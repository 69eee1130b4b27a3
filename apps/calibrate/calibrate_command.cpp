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
#include "apps/terminal/progress.h"
#include "apps/terminal/stop_request.h"
#include "apps/track/tracker_setup.h"
#include "calibration/calibrator.h"
#include "calibration/pose_collector.h"
#include "depthmocap/error.h"
#include "depthmocap/tracker.h"
#include "libtracker/classify/forest_classifier.h"
#include "libtracker/classify/forest_file.h"
#include "libtracker/core/shipped_files.h"
#include "libtracker/recording/recording.h"
#include "libtracker/sensor/open_source.h"

namespace depthmocap {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr std::size_t kMostTracked = 300;  // frames in which other poses are looked for
constexpr int kOtherFrames = 12;
constexpr std::chrono::milliseconds kWait{200};  // for one frame of a camera
constexpr std::size_t kFewestOthers = 4;

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
};

std::shared_ptr<const CalibratorModels> calibratorModels(const CalibrateOptions& o) {
  const auto models = std::make_shared<CalibratorModels>();
  models->tpose = std::make_shared<const ForestClassifier>(loadForest(shippedFile("tpose.forest")));
  models->general = Models::load(o.forest, o.posedb).classifier;
  models->space = loadShapeSpace(o.shape_space.empty() ? shippedFile("shape_space.json") : o.shape_space);
  return models;
}

bool readFrame(RecordingReader& reader, std::size_t i, DepthFrame& frame) {
  try {
    reader.read(i, frame);
    return true;
  } catch (const Error& error) {
    std::cerr << "depthmocap: warning: " << error.what() << "; frame skipped\n";
    return false;
  }
}

void collect(RecordingReader& reader, Calibrator& calibrator) {
  Progress progress("looking for the T-pose", reader.frameCount());
  DepthFrame frame;
  for (std::size_t i = 0; i < reader.frameCount(); ++i) {
    if (readFrame(reader, i, frame)) calibrator.add(frame);
    progress.update(i + 1);
  }
}

// What the tracker makes of a recording.
struct OtherPoses {
  std::vector<PoseObservation> observations;
  double stature_m = 0;  // [m] of the body that it was tracked with in the end
};

// Tracks the recording with the body that the T-pose gave, or (null) with an average one of the assumed stature, to
// learn from other poses.
OtherPoses otherPoses(const CalibrateOptions& o, RecordingReader& reader, const Actor* actor,
                      double assumed_stature_m = 0) {
  TrackOptions track;
  track.forest = o.forest;
  track.posedb = o.posedb;
  std::optional<Actor> body;
  if (actor != nullptr) body = *actor;
  track.threads = o.config.threads;
  track.assumed_stature_m = assumed_stature_m;
  Tracker tracker(loadModels(track), reader.info().camera, trackerConfig(track), body);
  PoseCollector collector(reader.info().camera, o.config.points_per_part);
  const std::size_t count = std::min(reader.frameCount(), kMostTracked);
  Progress progress("looking at other poses", count);
  DepthFrame frame;
  for (std::size_t i = 0; i < count; ++i) {
    if (readFrame(reader, i, frame)) collector.add(frame, tracker.process(frame));
    progress.update(i + 1);
  }
  return {collector.chosen(kOtherFrames), statureOf(tracker.actor().skeleton.lengths)};
}

// What a calibration gave and how long its solve took.
struct Calibration {
  Actor actor;
  RecordingInfo info;
  double solve_s = 0;
};

template <typename Work>
double timed(Work&& work) {
  const auto start = Clock::now();
  work();
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// Until enough good frames have come; tells the actor what to change.
void watch(DepthSource& source, Calibrator& calibrator, double limit_s) {
  const StopRequest on_ctrl_c;
  const auto start = SensorClock::now();
  SensorFrame frame;
  std::string said;
  while (!calibrator.enough() && !StopRequest::made()) {
    if (SensorClock::now() - start > std::chrono::duration<double>(limit_s)) break;
    const SourceState state = source.next(frame, kWait);
    if (state == SourceState::Ended) break;
    if (state != SourceState::Frame) continue;
    const TPoseVerdict verdict = calibrator.add(frame.depth);
    const std::string text = verdict.good() ? "good, hold still" : verdict.advice;
    if (text != said) std::cerr << text << '\n';
    said = text;
  }
}

Calibration calibrateLive(const CalibrateOptions& o) {
  const auto source = openSource(o.recording.string(), {});
  Calibrator calibrator(calibratorModels(o), source->info().camera, o.config);
  watch(*source, calibrator, o.seconds);
  Calibration result;
  result.info = source->info();
  result.solve_s = timed([&] { result.actor = calibrator.solve(); });
  if (!o.preview.empty()) {
    writeCalibrationPicture(o.preview, calibrator.shown(), result.actor, result.info.camera);
  }
  return result;
}

Calibration calibrateRecording(const CalibrateOptions& o) {
  const auto reader = openRecording(o.recording);
  Calibrator calibrator(calibratorModels(o), reader->info().camera, o.config);
  collect(*reader, calibrator);
  Calibration result;
  result.info = reader->info();
  if (o.config.any_pose) {
    // Once to learn the size, once with it.
    const OtherPoses others = otherPoses(o, *reader, nullptr, otherPoses(o, *reader, nullptr).stature_m);
    result.solve_s = timed([&] { result.actor = calibrator.solveWithoutTPose(others.observations, others.stature_m); });
    return result;
  }
  result.solve_s = timed([&] { result.actor = calibrator.solve(); });
  if (!o.tpose_only) {
    const Actor as_seen = asSeen(result.actor);
    const auto others = otherPoses(o, *reader, &as_seen).observations;
    if (others.size() >= kFewestOthers) result.actor = calibrator.solve(others);
  }
  if (!o.preview.empty()) {
    writeCalibrationPicture(o.preview, calibrator.shown(), result.actor, result.info.camera);
  }
  return result;
}

void calibrate(CalibrateOptions o) {
  o.config.check.tolerance_rad = o.tolerance_deg * std::numbers::pi / 180.0;
  const bool is_camera = !fs::exists(o.recording) && checkSourceName(o.recording.string()).empty();
  if (is_camera && o.config.any_pose) {
    throw Error("--any-pose needs a recording", o.recording.string(), "record first, or stand in a T-pose");
  }
  Calibration result = is_camera ? calibrateLive(o) : calibrateRecording(o);
  ActorMeasurement measured = *result.actor.measured;
  measured.camera = result.info.camera_name;
  result.actor.measured = std::make_shared<const ActorMeasurement>(std::move(measured));
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
