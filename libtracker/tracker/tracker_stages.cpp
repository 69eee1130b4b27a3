#include "libtracker/tracker/tracker_stages.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "libtracker/classify/classify.h"
#include "libtracker/classify/label_image.h"
#include "libtracker/classify/side_expectation.h"
#include "libtracker/skeleton/facing_of.h"
#include "libtracker/solve/size_estimate.h"
#include "libtracker/tracker/alignment.h"
#include "libtracker/tracker/joint_confidence.h"

namespace depthmocap {
namespace {

// The config as the stages take it. The stride is that of a usual focal length: a coarser image is looked at more
// closely.
TrackerConfig forCamera(TrackerConfig config, const CameraModel& camera) {
  config.validate();
  config.classify.threads = config.threads;
  config.classify.stride =
      std::max(1, static_cast<int>(std::lround(config.classify.stride * camera.fx / kReferenceFocal_px)));
  return config;
}

}  // namespace

Tracker::Stages::Stages(std::shared_ptr<const TrackerModels> m, const CameraModel& c, const TrackerConfig& cfg,
                        const std::optional<ActorModel>& given)
    : models(std::move(m)),
      camera(c),
      config(forCamera(cfg, c)),
      first_size(given ? *given : averageActor(averageBoneLengths(cfg.policy.assumed_stature_m)), given.has_value(),
                 cfg.policy.adapt_s),
      size(first_size),
      search_stature_m(statureOf(size.actor().skeleton.lengths)),
      segmenter(config.segment),
      finder(config.markers),
      search(models->database, size.actor().skeleton, size.actor().markers, config.search),
      prior_builder(config.prior),
      solver(config.solve),
      global(config.prior.neighbours.back(), config.policy.start_poses),
      dense(config.surface, config.free_space, config.policy.dense_rounds) {}

void Tracker::Stages::begin(const DepthFrame& frame, const KnownEvidence& given) {
  known = given;
  dt_s = out.time_s > 0 ? frame.time_s - out.time_s : 0.0;
  out.frame = frame.frame;
  out.time_s = frame.time_s;
  out.reinitialised = false;
  out.solver_iterations = 0;
  out.rms_marker_m = 0;
  predict();
  expectActor();
}

// Where the markers are expected, from the poses before.
void Tracker::Stages::predict() {
  classify_config.facing_prior = config.classify.facing_prior;
  predicted = history.hasPose();
  if (!predicted) return;
  q_predicted = history.predicted(out.time_s);
  if (config.policy.expect_sides) classify_config.facing_prior = expectedFacing(q_predicted);
  predicted_camera = rotated(R_world_camera.transpose(), modelMarkers(size.actor(), q_predicted, fk));
  trunk_camera = predicted_camera.position.col(partIndex(Part::Torso));
  joints_predicted_camera = R_world_camera.transpose() * jointPositions(size.actor().skeleton, q_predicted);
}

// A lost actor is waited for; then the next one may be anybody, of any size.
void Tracker::Stages::expectActor() {
  expected_actor.reset();
  const double unseen_s = history.unseen(out.time_s);
  if (wanted_camera) {
    expected_actor = {*wanted_camera, std::numeric_limits<double>::infinity()};
  } else if (history.state() == TrackState::Tracking) {
    expected_actor = {trunk_camera, unseen_s};
  } else if (unseen_s <= config.policy.absent_s) {
    expected_actor = {trunk_camera + R_world_camera.transpose() * history.walkedOn(out.time_s), unseen_s};
  } else {
    history = {};
    size = first_size;
  }
}

// The floor says which way is up; where it says so anew, the poses before are turned with the world.
void Tracker::Stages::levelWorld() {
  const Eigen::Matrix3d R_before_camera = R_world_camera;
  if (!world.observe(segmentation)) return;
  history.turnWorld(R_world_camera * R_before_camera.transpose());
  feet.reset();
  predict();
}

// (1): a body part for each pixel; the pose before helps to tell left from right.
void Tracker::Stages::labelPixels(const DepthImage& depth) {
  classify(models->forest, depth, segmentation.mask, camera.fx, classify_config, classify_memory, pixels);
  if (known.labels != nullptr) labelAs(*known.labels, config.threads, classify_memory, pixels);
  if (predicted && config.policy.expect_sides) expectSides(joints_predicted_camera, camera, config.threads, pixels);
}

// (2): one marker for each part.
void Tracker::Stages::findMarkers(const MarkerSet* expected_camera) {
  finder.find(pixels, camera, size.actor().radii_m, expected_camera, out.markers_camera);
  if (known.markers_camera != nullptr) out.markers_camera = *known.markers_camera;
  markers_world = rotated(R_world_camera, out.markers_camera);
}

// (3) and (4): the nearest poses and the local model. Without history the global search does both.
void Tracker::Stages::buildPrior() {
  if (!predicted || markers_world.seenCount() < config.policy.min_markers) return;
  PoseQuery query;
  query.markers = markers_world;
  query.has_history = true;
  query.q_prev = history.prev();
  query.q_prev2 = history.prev2(out.time_s);
  query.heading = history.prev()[kRootRy];
  query.scale = searchScale();
  search.search(query, config.prior.neighbours.back(), neighbours);
  prior_builder.build(models->database, neighbours, prior);
}

void Tracker::Stages::solve(const DepthImage& depth) {
  dense.observe(pixels, depth, segmentation.mask, camera, R_world_camera);
  const bool enough =
      markers_world.seenCount() >= config.policy.min_markers && segmentation.visible_share >= config.policy.min_visible;
  const bool found = enough && (predicted ? solveNext(depth) : solveFirst(depth));
  if (found) wanted_camera.reset();
  if (!found) history.miss(out.time_s, config.policy.coast_s);
  if (!found || out.reinitialised) return feet.reset();
  feet.observe(size.actor().skeleton, history.prev(), out.time_s, world.floor());
}

// (5) from the pose before; where that fits badly, a global search competes with it.
bool Tracker::Stages::solveNext(const DepthImage& depth) {
  Pose q = q_predicted;
  const Pose q_prev2 = history.prev2(out.time_s);
  const ActorModel& actor = size.actor();
  MapInput input{actor.skeleton, actor.markers, markers_world, &prior, &history.prev(), &q_prev2};
  if (config.policy.hold_feet) input.contacts = &feet.contacts();
  summary = solver.solve(input, q);
  if (summary.rms_marker_m > config.policy.suspect_rms_m) {
    const auto& other =
        global.find(markers_world, searchScale(), actor, models->database, search, prior_builder, solver);
    if (other.found && other.summary.energy < config.policy.switch_gain * energyOfImage(summary)) {
      summary = other.summary;
      q = other.q;
      input.contacts = nullptr;
      out.reinitialised = true;
    }
  }
  dense.refine(models->surface, actor, input, solver, q, summary);
  if (config.policy.expect_sides && turnAround(depth)) return true;
  if (!believed(summary)) return false;
  history.accept(q, out.time_s, out.reinitialised);
  if (size.adapting()) size.observe(observedScale(q), dt_s);
  return true;
}

// How much larger the actor is than the skeleton in use: by the height of the whole person where it is in view, else by
// the markers; 1 if neither can tell.
double Tracker::Stages::observedScale(const Pose& q) {
  if (!segmentation.touches_border && segmentation.visible_share == 1) {
    const double ratio = dense.extentRatio(models->surface, size.actor(), q);
    if (ratio > 0) return ratio;
  }
  fk.update(size.actor().skeleton, q);
  const SizeEstimate estimate = estimateSize(fk, size.actor().markers, markers_world);
  return estimate.valid ? estimate.scale : 1.0;
}

// What the caller sees of the frame.
void Tracker::Stages::finish() {
  labelImage(pixels, segmentation.mask, out.labels);
  out.state = history.state();
  out.R_world_camera = R_world_camera;
  out.floor_world = world.floor();
  out.lengths = size.actor().skeleton.lengths;
  out.stature_m = statureOf(out.lengths);
  out.confidence.setZero();
  if (out.state == TrackState::Lost) return;
  out.q = history.prev();
  out.model_markers_camera = rotated(R_world_camera.transpose(), modelMarkers(size.actor(), out.q, fk));
  out.joints_camera = R_world_camera.transpose() * jointPositions(size.actor().skeleton, out.q);
  if (out.state != TrackState::Tracking) return;
  out.confidence = jointConfidence(out.markers_camera, out.model_markers_camera);
  out.rms_marker_m = summary.rms_marker_m;
  out.solver_iterations = summary.iterations;
}

}  // namespace depthmocap
