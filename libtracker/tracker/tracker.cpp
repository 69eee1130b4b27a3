#include "libtracker/tracker/tracker.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "libtracker/markers/find_markers.h"
#include "libtracker/posedb/pose_search.h"
#include "libtracker/prior/local_prior_builder.h"
#include "libtracker/segment/segment.h"
#include "libtracker/skeleton/facing_of.h"
#include "libtracker/solve/size_estimate.h"
#include "libtracker/tracker/alignment.h"
#include "libtracker/tracker/dense_refinement.h"
#include "libtracker/tracker/foot_watch.h"
#include "libtracker/tracker/global_search.h"
#include "libtracker/tracker/joint_confidence.h"
#include "libtracker/tracker/side_expectation.h"
#include "libtracker/tracker/size_adapter.h"
#include "libtracker/tracker/stage_clock.h"
#include "libtracker/tracker/track_history.h"
#include "libtracker/tracker/upright_world.h"

namespace depthmocap {
namespace {

constexpr float kLikelyFacing = 0.001F;  // share from which a side is tried for the first pose
// [energy] Weight of the logarithm of a facing's share. The energy of the solved pose tells the sides apart better: on
// the first frames of 30 real sequences and 12 rendered ones it preferred the right one to the opposite one in 39
// cases.
constexpr double kFacingWeight = 1.5;
constexpr float kDisputedShare = 0.01F;  // a side that the image gives less is disputed
constexpr int kDisputePatience = 3;      // [frames] before other sides are tried, and
constexpr int kDisputePeriod = 15;       // [frames] between such trials
constexpr int kFirstSizeRounds = 3;      // solve, rescale, solve again: the first size converges in this many rounds

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

// The stages, their working memory and what is known from the frames before.
struct Tracker::Stages {
  Stages(std::shared_ptr<const TrackerModels> m, const CameraModel& c, const TrackerConfig& cfg,
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

  void begin(const DepthFrame& frame, const KnownEvidence& given);
  void predict();
  void levelWorld();
  void labelPixels(const DepthImage& depth);
  void findMarkers(const MarkerSet* expected_camera);
  void buildPrior();
  void solve(const DepthImage& depth);
  struct FirstPose {
    Pose q;
    MapSummary summary;
    SizeAdapter size;
    Facing facing = Facing::Front;
    double cost = 0;  // against other facings' poses
  };
  bool solveFirst(const DepthImage& depth);
  void assume(Facing facing, const DepthImage& depth);
  std::optional<FirstPose> poseFromScratch();
  bool accept(const std::optional<FirstPose>& first);
  bool turnAround(const DepthImage& depth);
  std::optional<FirstPose> poseFromAnySide(const FacingShares& shares, const DepthImage& depth);
  bool solveNext(const DepthImage& depth);
  // Without what the frames before say.
  [[nodiscard]] double energyOfImage(const MapSummary& fit) const {
    return fit.energy - config.solve.lambda_smooth * fit.e_smooth - config.solve.lambda_contact * fit.e_contact;
  }
  void finish();
  [[nodiscard]] double searchScale() const { return statureOf(size.actor().skeleton.lengths) / search_stature_m; }
  [[nodiscard]] bool believed(const MapSummary& fit) const { return fit.rms_marker_m <= config.policy.max_rms_m; }
  void expectActor();
  double observedScale(const Pose& q);

  const std::shared_ptr<const TrackerModels> models;
  const CameraModel camera;
  const TrackerConfig config;
  UprightWorld world;
  const Eigen::Matrix3d& R_world_camera = world.R_world_camera();

  const SizeAdapter first_size;
  SizeAdapter size;
  const double search_stature_m;  // of the skeleton whose markers the search holds
  TrackHistory history;
  FootWatch feet;

  Segmenter segmenter;
  MarkerFinder finder;
  PoseSearch search;
  LocalPriorBuilder prior_builder;
  MapSolver solver;
  GlobalSearch global;
  DenseRefinement dense;

  std::optional<Eigen::Vector3d> wanted_camera;            // where to look for somebody, once
  Eigen::Vector3d trunk_camera = Eigen::Vector3d::Zero();  // where it was last expected

  // Of the present frame.
  KnownEvidence known;
  double dt_s = 0;
  bool predicted = false;
  Pose q_predicted = Pose::Zero();
  MarkerSet predicted_camera;
  JointPositions joints_predicted_camera;
  ClassifyConfig classify_config = config.classify;  // with what is known of the facing
  std::optional<ExpectedActor> expected_actor;
  Segmentation segmentation;
  ClassifyMemory classify_memory;
  ClassifiedPixels pixels;
  ClassifiedPixels pixels_before;
  int disputed_frames = 0;
  MarkerSet markers_world;
  std::vector<PoseNeighbour> neighbours;
  LocalPrior prior;
  MapSummary summary;
  ForwardKinematics fk;
  TrackedFrame out;
};

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

// The first pose, or the first after a loss.
bool Tracker::Stages::solveFirst(const DepthImage& depth) {
  return accept(poseFromAnySide(pixels.facing, depth));
}

// The image keeps saying that the actor is seen from another side than the pose says. The pose that explains the image
// best decides; true if that is a new one.
bool Tracker::Stages::turnAround(const DepthImage& depth) {
  const auto tracked = static_cast<std::size_t>(facingOf(q_predicted));
  const double doubt = static_cast<double>(pixels.facing_by_image[tracked]);
  disputed_frames = doubt < kDisputedShare ? disputed_frames + 1 : 0;
  if (disputed_frames % kDisputePeriod != kDisputePatience) return false;
  const double tracked_cost = energyOfImage(summary) - kFacingWeight * std::log(std::max<double>(doubt, kLikelyFacing));
  const SizeAdapter size_before = size;
  pixels_before = pixels;
  const MarkerSet markers_before = out.markers_camera;
  const std::optional<FirstPose> other = poseFromAnySide(pixels.facing_by_image, depth);
  if (other && other->cost < config.policy.switch_gain * tracked_cost) return accept(other);
  size = size_before;
  pixels = pixels_before;
  out.markers_camera = markers_before;
  markers_world = rotated(R_world_camera, out.markers_camera);
  return false;
}

// A pose from this image alone. Where the classifier doubts from which side the actor is seen, each likely side is
// tried, and the pose that explains the image best decides.
std::optional<Tracker::Stages::FirstPose> Tracker::Stages::poseFromAnySide(const FacingShares& shares,
                                                                           const DepthImage& depth) {
  if (models->forest.facings == 1) return poseFromScratch();
  std::optional<FirstPose> best;
  const SizeAdapter size_before = size;
  for (std::size_t f = 0; f < kFacingCount; ++f) {
    if (shares[f] < kLikelyFacing) continue;
    size = size_before;
    assume(static_cast<Facing>(f), depth);
    std::optional<FirstPose> pose = poseFromScratch();
    if (!pose) continue;
    pose->facing = static_cast<Facing>(f);
    pose->cost = pose->summary.energy - kFacingWeight * std::log(static_cast<double>(shares[f]));
    if (!best || pose->cost < best->cost) best = pose;
  }
  size = best ? best->size : size_before;
  if (best) assume(best->facing, depth);
  return best;
}

// Classification and markers again, seen from a given side.
void Tracker::Stages::assume(Facing facing, const DepthImage& depth) {
  FacingShares certain{};
  certain[static_cast<std::size_t>(facing)] = 1.0F;
  assumeFacing(certain, config.threads, classify_memory, pixels);
  findMarkers(nullptr);
  dense.observe(pixels, depth, segmentation.mask, camera, R_world_camera);
}

// Global search; an unknown actor's size is fitted to the pose at once.
std::optional<Tracker::Stages::FirstPose> Tracker::Stages::poseFromScratch() {
  const GlobalSearch::Result* found = nullptr;
  for (int round = 0; round < kFirstSizeRounds; ++round) {
    found = &global.find(markers_world, searchScale(), size.actor(), models->database, search, prior_builder, solver);
    if (!found->found || !size.adapting()) break;
    size.rescale(observedScale(found->q));
  }
  if (!found->found || !believed(found->summary)) return std::nullopt;
  FirstPose first{found->q, found->summary, size};
  const ActorModel& actor = size.actor();
  dense.refine(models->surface, actor, {actor.skeleton, actor.markers, markers_world, &global.prior()}, solver, first.q,
               first.summary);
  return first;
}

bool Tracker::Stages::accept(const std::optional<FirstPose>& first) {
  if (!first) return false;
  disputed_frames = 0;
  summary = first->summary;
  history.accept(first->q, out.time_s, true);
  out.reinitialised = true;
  return true;
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

Tracker::Tracker(std::shared_ptr<const TrackerModels> models, const CameraModel& camera, const TrackerConfig& config,
                 const std::optional<ActorModel>& actor)
    : stages_(std::make_unique<Stages>(std::move(models), camera, config, actor)) {}

Tracker::~Tracker() = default;

const ActorModel& Tracker::actor() const {
  return stages_->size.actor();
}

void Tracker::reset() {
  stages_->history = {};
  stages_->size = stages_->first_size;
  stages_->wanted_camera.reset();
}

void Tracker::lockOn(const Eigen::Vector3d& p_camera) {
  reset();
  stages_->wanted_camera = p_camera;
}

void Tracker::use(std::shared_ptr<const TrackerModels> models, const ActorModel& actor) {
  next_stages_ = std::make_unique<Stages>(std::move(models), stages_->camera, stages_->config, actor);
}

// The method on one page (Su, Chai, Xia 2016); equation numbers as in docs/architecture.md.
const TrackedFrame& Tracker::process(const DepthFrame& frame, const KnownEvidence& known) {
  if (next_stages_) stages_ = std::move(next_stages_);
  Stages& s = *stages_;
  StageClock clock(s.out.ms);
  s.begin(frame, known);

  s.segmenter.segment(frame.depth, s.camera, s.expected_actor ? &*s.expected_actor : nullptr, s.segmentation);
  s.levelWorld();
  clock.lap(&StageTimes::segment);

  // (1) a body part for each pixel
  s.labelPixels(frame.depth);
  clock.lap(&StageTimes::classify);

  // (2) one marker for each part
  s.findMarkers(s.predicted ? &s.predicted_camera : nullptr);
  clock.lap(&StageTimes::markers);

  // (3) nearest poses in the database, (4) local linear model over them
  s.buildPrior();
  clock.lap(&StageTimes::prior);

  // (5) maximum a posteriori pose
  s.solve(frame.depth);
  s.finish();
  clock.lap(&StageTimes::solve);
  return s.out;
}

}  // namespace depthmocap
