#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>

#include <fmt/format.h>

#include "apps/calibration_picture.h"
#include "apps/commands.h"
#include "apps/progress.h"
#include "apps/shipped_files.h"
#include "calibration/calibrator.h"
#include "libtracker/core/error.h"
#include "libtracker/recording/recording.h"

namespace depthmocap {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

struct CalibrateOptions {
  fs::path recording;
  fs::path out;
  fs::path preview;
  fs::path forest;
  fs::path shape_space;
  CalibratorConfig config;
  double tolerance_deg = 15;
};

std::shared_ptr<const CalibratorModels> loadModels(const CalibrateOptions& o) {
  const auto models = std::make_shared<CalibratorModels>();
  models->tpose = loadForest(shippedFile("tpose.forest"));
  models->general = loadForest(o.forest.empty() ? shippedFile("general.forest") : o.forest);
  models->space = loadShapeSpace(o.shape_space.empty() ? shippedFile("shape_space.json") : o.shape_space);
  return models;
}

// Every frame that can be read; advice when it changes.
void collect(RecordingReader& reader, Calibrator& calibrator) {
  Progress progress("looking for the T-pose", reader.frameCount());
  DepthFrame frame;
  for (std::size_t i = 0; i < reader.frameCount(); ++i) {
    try {
      reader.read(i, frame);
    } catch (const Error& error) {
      std::cerr << "depthmocap: warning: " << error.what() << "; frame skipped\n";
      continue;
    }
    calibrator.add(frame);
    progress.update(i + 1);
  }
}

void calibrate(CalibrateOptions o) {
  o.config.check.tolerance_rad = o.tolerance_deg * 3.14159265358979 / 180.0;
  const auto reader = openRecording(o.recording);
  Calibrator calibrator(loadModels(o), reader->info().camera, o.config);
  collect(*reader, calibrator);
  const auto start = Clock::now();
  CalibratedActor actor = calibrator.solve();
  actor.camera = reader->info().camera_name;
  if (!o.preview.empty()) writeCalibrationPicture(o.preview, calibrator.shown(), actor, reader->info().camera);
  writeActorFile(o.out, actor);
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
  std::cerr << fmt::format("{} of {:.3f} m from {} frames, surface within {:.1f} mm, confidence {:.2f}, {:.2f} s\n",
                           actor.sex == Sex::Male ? "man's body" : "woman's body", actor.stature(),
                           actor.fit.tpose_frames, 1000 * actor.fit.surface_m, actor.fit.confidence, seconds);
}

}  // namespace

void addCalibrateCommand(CLI::App& app) {
  CLI::App* command = app.add_subcommand("calibrate", "Measures an actor who stands in a T-pose.");
  const auto o = std::make_shared<CalibrateOptions>();
  command->add_option("recording", o->recording, "Recording with at least ten frames of T-pose")
      ->type_name("REC")
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
  command->add_option("--forest", o->forest, "Body-part classifier that the tracker will use");
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
