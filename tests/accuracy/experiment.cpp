// Tracks a recording as `depthmocap replay` does, for measurements that the program itself has no use for
// (scripts/experiments, docs/lab/accuracy.md): with what only a rendered recording knows (the true body, the part of
// every pixel, exact markers), with another search or local model, with disturbed frames.
#include <CLI/CLI.hpp>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <limits>
#include <map>
#include <memory>
#include <opencv2/imgcodecs.hpp>
#include <optional>
#include <string>
#include <utility>

#include "apps/track/track_options.h"
#include "apps/track/track_outputs.h"
#include "apps/track/tracker_setup.h"
#include "depthmocap/error.h"
#include "depthmocap/tracker.h"
#include "depthmocap/world_frame.h"
#include "libtracker/actor/make_actor.h"
#include "libtracker/body/builtin_body.h"
#include "libtracker/body/sample_surface.h"
#include "libtracker/recording/recording.h"
#include "libtracker/recording/track_files.h"
#include "libtracker/session/body_pass.h"
#include "libtracker/session/pose_pipeline.h"
#include "libtracker/tracker/alignment.h"
#include "libtracker/tracker/measurement.h"
#include "tests/accuracy/disturbance.h"
#include "tests/support/known_labels.h"

namespace depthmocap {
namespace {

namespace fs = std::filesystem;

constexpr int kSurfacePoints = 1500;

constexpr std::array<std::pair<const char*, double MapConfig::*>, 6> kWeights = {{
    {"lambda-prior", &MapConfig::lambda_prior},
    {"lambda-marker", &MapConfig::lambda_marker},
    {"lambda-smooth", &MapConfig::lambda_smooth},
    {"lambda-surface", &MapConfig::lambda_surface},
    {"sigma-surface", &MapConfig::sigma_surface_m},
    {"velocity-share", &MapConfig::velocity_share},
}};

struct ExperimentOptions {
  fs::path recording;
  TrackOptions track;
  double look_ahead_s = 0;  // each frame by those before it alone, as live
  std::string true_body;    // SEX,STATURE,WEIGHT of the built-in body that was rendered
  double actor_scale = 1;   // of that body or of --actor
  bool two_passes = false;  // as replay: the body is fitted first
  bool true_labels = false;
  bool true_markers = false;
  int neighbours = 0;  // K alone, 0 = the default
  int dims = 0;        // B alone, 0 = the default
  int candidates = 0;  // of the search, 0 = the default
  MapConfig weights;   // of equation (5); NaN = the tracker's
  Disturbance disturbance;
};

BodyShape shapeFrom(const std::string& text) {
  char sex = 'm';
  BodyShape shape;
  if (std::sscanf(text.c_str(), "%c,%lf,%lf", &sex, &shape.stature_m, &shape.weight_kg) != 3) {
    throw Error("is not SEX,STATURE,WEIGHT", "--true-body " + text, "for example m,1.80,75");
  }
  shape.sex = sex == 'f' ? Sex::Female : Sex::Male;
  return shape;
}

// The body of a calibration, or the one that was rendered; none: the tracker's average body.
std::optional<Actor> bodyOf(const ExperimentOptions& o) {
  std::optional<Actor> actor = actorOf(o.track);
  if (!o.true_body.empty()) {
    const BodySurface body = makeBuiltinBody(shapeFrom(o.true_body));
    actor = averageActor(body.skeleton.lengths,
                         std::make_shared<const SurfaceModel>(sampleSurface(body, kSurfacePoints, 1)));
  }
  if (!actor || o.actor_scale == 1) return actor;
  return averageActor(actor->skeleton.lengths.scaled(o.actor_scale), actor->surface);
}

TrackerConfig configOf(const ExperimentOptions& o) {
  TrackerConfig config = trackerConfig(o.track);
  if (o.neighbours > 0) config.prior.neighbours = {o.neighbours};
  if (o.dims > 0) config.prior.dims = {o.dims};
  if (o.candidates > 0) config.search.candidates = o.candidates;
  for (const auto& [name, field] : kWeights) {
    if (!std::isnan(o.weights.*field)) config.solve.*field = o.weights.*field;
  }
  return config;
}

// What a rendered recording knows of its frames.
class Truth {
 public:
  Truth(const ExperimentOptions& o, const std::optional<Actor>& actor) : folder_(o.recording / "truth") {
    labels_wanted_ = o.true_labels;
    if (!o.true_markers) return;
    if (!actor) throw Error("needs --true-body", "--true-markers", "exact markers are those of the exact body");
    ForwardKinematics fk;
    for (const PoseRow& row : readPoseFile(folder_ / "pose.csv")) {
      markers_[row.frame] = rotated(uprightWorldFromCamera().transpose(), modelMarkers(*actor, row.q, fk));
    }
  }

  // For the next frame.
  void give(std::int64_t frame, KnownLabels& classifier, Tracker& tracker) {
    if (labels_wanted_) classifier.setLabels(labels(frame));
    const auto markers = markers_.find(frame);
    if (markers != markers_.end()) TrackerMeasurement::setMarkers(tracker, markers->second);
  }

 private:
  const PartImage& labels(std::int64_t frame) {
    std::array<char, 32> name{};
    std::snprintf(name.data(), name.size(), "%06lld.png", static_cast<long long>(frame));
    const fs::path path = folder_ / "labels" / name.data();
    const cv::Mat image = cv::imread(path.string(), cv::IMREAD_GRAYSCALE);
    if (image.empty()) throw Error("cannot be read", path.string(), "only rendered recordings have true labels");
    labels_.reset(image.cols, image.rows, 0);
    std::copy(image.begin<std::uint8_t>(), image.end<std::uint8_t>(), labels_.data.begin());
    return labels_;
  }

  fs::path folder_;
  bool labels_wanted_ = false;
  PartImage labels_;
  std::map<std::int64_t, MarkerSet> markers_;
};

void experiment(const ExperimentOptions& o) {
  const std::unique_ptr<RecordingReader> reader = openRecording(o.recording);
  const std::optional<Actor> body = bodyOf(o);
  Truth truth(o, body);
  Models models = loadModels(o.track);
  const auto classifier = std::make_shared<KnownLabels>(models.classifier);
  models.classifier = classifier;
  Tracker tracker(models, reader->info().camera, configOf(o), body);
  TrackOutputs outputs(o.track, reader->info());
  RunStats stats;
  PosePipeline pipeline(tracker, o.look_ahead_s, o.track.smooth, stats);
  pipeline.addSink(outputs);
  if (o.two_passes) fitBodies(*reader, tracker, {}, {});
  DepthFrame frame;
  for (std::size_t i = 0; i < reader->frameCount(); ++i) {
    reader->read(i, frame);
    disturb(o.disturbance, frame);
    truth.give(frame.frame, *classifier, tracker);
    pipeline.process(i, frame);
  }
  pipeline.finish();
  outputs.finish();
  if (!o.track.stats.empty()) stats.write(o.track.stats, 0, !body);
}

void addOptions(CLI::App& app, ExperimentOptions& o) {
  app.add_option("recording", o.recording)->required();
  addTrackOptions(app, o.track);
  addLookAheadOption(app, o.look_ahead_s);
  app.add_option("--true-body", o.true_body, "Track with the built-in body of this SEX,STATURE,WEIGHT");
  app.add_option("--actor-scale", o.actor_scale, "Track with that body, or --actor's, so many times as large")
      ->check(CLI::Range(0.5, 2.0));
  app.add_flag("--two-passes", o.two_passes, "Fit the body over the first seconds, then track, as replay does");
  app.add_flag("--true-labels", o.true_labels, "Take each pixel's part from truth/labels");
  app.add_flag("--true-markers", o.true_markers, "Take the markers from truth/pose.csv and the true body");
  app.add_option("--neighbours", o.neighbours, "K of the local model; otherwise the default");
  app.add_option("--dims", o.dims, "B of the local model without gaussian; otherwise chosen");
  app.add_option("--candidates", o.candidates, "Poses that the index proposes");
  for (const auto& [name, field] : kWeights) {
    app.add_option(std::string("--") + name, o.weights.*field,
                   "Of equation (5), see MapConfig; otherwise the tracker's");
  }
  app.add_option("--occlude", o.disturbance.occluded_share, "Share of the actor hidden by a board")
      ->check(CLI::Range(0.0, 0.95));
  app.add_option("--occluder", o.disturbance.occluder, "Where the board comes from")
      ->check(CLI::IsMember({"below", "left", "right"}));
  app.add_option("--board", o.disturbance.board_m, "Distance of the board [m]; 0: what it hides is not measured");
  app.add_option("--first-blank", o.disturbance.first_blank, "First frame without any measurement");
  app.add_option("--last-blank", o.disturbance.last_blank, "Last frame without any measurement");
}

int run(int argc, char** argv) {
  CLI::App app{"Tracks a recording for a measurement."};
  ExperimentOptions options;
  for (const auto& [name, field] : kWeights) options.weights.*field = std::numeric_limits<double>::quiet_NaN();
  addOptions(app, options);
  CLI11_PARSE(app, argc, argv);
  experiment(options);
  return 0;
}

}  // namespace
}  // namespace depthmocap

int main(int argc, char** argv) {
  try {
    return depthmocap::run(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "experiment: " << error.what() << '\n';
    return 1;
  }
}
