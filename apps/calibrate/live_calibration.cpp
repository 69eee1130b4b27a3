#include "apps/calibrate/live_calibration.h"

#include <cmath>

#include <fmt/format.h>

#include "apps/track/tracker_setup.h"
#include "depthmocap/error.h"
#include "libtracker/classify/forest_classifier.h"
#include "libtracker/classify/forest_file.h"
#include "libtracker/core/shipped_files.h"

namespace depthmocap {
namespace {

constexpr double kCountdown_s = 3.0;
constexpr double kPatience_s = 30.0;  // after the countdown

std::shared_ptr<const CalibratorModels> calibratorModels(const TrackOptions& options) {
  const auto models = std::make_shared<CalibratorModels>();
  models->tpose = std::make_shared<const ForestClassifier>(loadForest(shippedFile("tpose.forest")));
  models->general = Models::load(options.forest, options.posedb).classifier;
  models->space = loadShapeSpace(shippedFile("shape_space.json"));
  return models;
}

CalibratorConfig calibratorConfig(const TrackOptions& options) {
  CalibratorConfig config;
  config.threads = options.threads;
  return config;
}

}  // namespace

LiveCalibration::LiveCalibration(const TrackOptions& options, const RecordingInfo& info)
    : options_(options),
      info_(info),
      calibrator_(calibratorModels(options), info.camera, calibratorConfig(options)),
      text_("Stand upright, facing the camera, arms out to the sides.") {}

bool LiveCalibration::say(const std::string& text) {
  if (text == text_) return false;
  text_ = text;
  return true;
}

bool LiveCalibration::add(const DepthFrame& frame) {
  if (!start_s_) start_s_ = frame.time_s;
  const double elapsed_s = frame.time_s - *start_s_;
  if (elapsed_s < kCountdown_s) {
    return say(fmt::format("Calibrating in {:.0f}: stand upright, facing the camera, arms out to the sides.",
                           std::ceil(kCountdown_s - elapsed_s)));
  }
  if (elapsed_s > kCountdown_s + kPatience_s) {
    throw Error("no T-pose was seen in time", "calibration", text_);
  }
  const TPoseVerdict verdict = calibrator_.add(frame);
  if (!verdict.good()) return say(verdict.advice + ".");
  return say(fmt::format("Good, hold still: {} frames.", calibrator_.goodFrames()));
}

void LiveCalibration::finish(const std::filesystem::path& path, Tracker& tracker) {
  Actor actor = calibrator_.solve();
  ActorMeasurement measured = *actor.measured;
  measured.camera = info_.camera_name;
  actor.measured = std::make_shared<const ActorMeasurement>(std::move(measured));
  writeActorFile(path, actor);
  tracker.use(asSeen(actor));
  text_ = fmt::format("Calibrated: {:.2f} m, written to {}", actor.stature_m(), path.string());
}

}  // namespace depthmocap
