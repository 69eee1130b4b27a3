#include "libtracker/tracker/pose_fitter.h"

#include <limits>
#include <utility>

#include "libtracker/solve/marker_term.h"
#include "libtracker/solve/size_estimate.h"
#include "libtracker/tracker/alignment.h"

namespace depthmocap {
namespace {

// Rounds of solving and scaling: the first size of an unknown actor has converged after this many.
constexpr int kFirstSizeRounds = 3;

// Height of a pose over the stature, from which the height tells the stature: who sits seems smaller the less the
// thighs are found to lie, and the other way round.
constexpr double kUpright = 0.85;
// Share of the size by the markers below which that by the height means another pose.
constexpr double kNotLess = 0.92;

// Steps of the solver in a round: a pose that is far from what was expected has a way to go before its matches tell.
constexpr int kUntilConverged = std::numeric_limits<int>::max();
constexpr DenseRounds kFirstRounds{4, kUntilConverged};
// Without the parts' help a surface comes nearer by smaller steps.
constexpr DenseRounds kRoundsByDistance{8, kUntilConverged};

// [m^2] Weight of the assumed stature against the spread of the markers, where not all of the actor is in view: the
// markers of an upper body alone (spread 0.2 to 0.6) were wrong by 15 to 30 % at 0.8 m, people differ by 5 %.
constexpr double kTypical_m2 = 1.0;

}  // namespace

PoseFitter::PoseFitter(std::shared_ptr<const PoseDatabase> database, const Actor& body, const TrackerConfig& config)
    : config_(config),
      database_(std::move(database)),
      search_stature_m_(body.stature_m()),
      search_(*database_, body.skeleton, body.markers, config.search),
      prior_builder_(config.prior),
      solver_(config.solve),
      global_(config.prior.neighbours.back(), config.policy.start_poses),
      dense_(config.surface, config.outline, config.free_space, config.policy.dense_rounds > 0) {}

void PoseFitter::look(const DepthImage& depth, const PersonRegion& actor, const CameraModel& camera,
                      const Eigen::Matrix3d& R_world_camera) {
  dense_.look(depth, actor.mask, !(actor.in_room && actor.cut_below), camera, R_world_camera);
  whole_in_view_ = !actor.touches_border && !actor.covered && !actor.cut_below;
}

void PoseFitter::buildPrior(const Evidence& evidence, const Prediction& prediction, const Actor& actor) {
  buildPriorAbout(legs_.complete(evidence.markers_world, actor), prediction, actor, prior_);
}

void PoseFitter::buildPriorAbout(const MarkerSet& markers_world, const Prediction& prediction, const Actor& actor,
                                 LocalPrior& prior) {
  PoseQuery query;
  query.markers = markers_world;
  query.has_history = true;
  query.q_prev = prediction.q_prev;
  query.q_prev2 = prediction.q_prev2;
  query.heading = prediction.q_prev[kRootRy];
  query.scale = searchScale(actor);
  search_.search(query, config_.prior.neighbours.back(), neighbours_);
  prior_builder_.build(*database_, neighbours_, prior);
}

bool PoseFitter::believed(const Hypothesis& fit) const {
  return fit.matching == Matching::ByDistance || fit.summary.rms_marker_m <= config_.policy.max_rms_m ||
         (fit.misfit && *fit.misfit <= config_.policy.max_misfit);
}

bool PoseFitter::isPuzzling(const Hypothesis& fit) const {
  return fit.misfit && *fit.misfit > config_.policy.suspect_misfit;
}

bool PoseFitter::explainsMore(const Hypothesis& other, const Hypothesis& fit) const {
  return other.misfit && fit.misfit && *other.misfit < config_.policy.misfit_gain * *fit.misfit;
}

Hypothesis PoseFitter::fitNext(const Evidence& evidence, const Prediction& prediction, const Actor& actor,
                               const FootContacts* contacts) {
  Hypothesis fit = fitByParts(evidence, prediction, actor, contacts);
  if (isPuzzling(fit)) {
    Hypothesis other = fitByDistance(evidence, prediction, actor);
    if (explainsMore(other, fit)) return other;
    dense_.takeBack();
  }
  if (believed(fit)) dense_.learnNoise(actor, fit.q);
  return fit;
}

Hypothesis PoseFitter::fitByDistance(const Evidence& evidence, const Prediction& prediction, const Actor& actor) {
  Hypothesis fit;
  fit.matching = Matching::ByDistance;
  fit.q = prediction.q;
  buildPriorAbout(modelMarkers(actor, prediction.q, fk_), prediction, actor, prior_of_prediction_);
  const MarkerSet none;
  MapInput input{actor.skeleton, actor.markers, none, &prior_of_prediction_, &prediction.q_prev, &prediction.q_prev2};
  dense_.refine(evidence.samples, Matching::ByDistance, actor, input, solver_, kRoundsByDistance, fit.q, fit.summary);
  fit.misfit = dense_.misfit(actor, fit.q);
  fit.summary.rms_marker_m = rmsOfSeen(evidence.markers_world, actor, fit.q);
  input.surface = dense_.matches();
  solver_.expandEvidence(input, fit.q, fit.evidence);
  return fit;
}

Hypothesis PoseFitter::fitByParts(const Evidence& evidence, const Prediction& prediction, const Actor& actor,
                                  const FootContacts* contacts) {
  Hypothesis fit;
  fit.q = prediction.q;
  const MarkerSet& markers = legs_.complete(evidence.markers_world, actor);
  MapInput input{actor.skeleton, actor.markers, markers, &prior_, &prediction.q_prev, &prediction.q_prev2};
  input.contacts = contacts;
  fit.summary = solver_.solve(input, fit.q);
  judgeBySeen(evidence.markers_world, actor, fit.q, fit.summary);
  if (fit.summary.rms_marker_m > config_.policy.suspect_rms_m) {
    const auto& other = global_.find(markers, searchScale(actor), actor, *database_, search_, prior_builder_, solver_);
    if (other.found && other.summary.energy < config_.policy.switch_gain * energyOfImage(fit.summary)) {
      fit.summary = other.summary;
      fit.q = other.q;
      fit.fresh = true;
      input.contacts = nullptr;
    }
  }
  finish(evidence, actor, input, fit);
  return fit;
}

// The dense term, and what it leaves.
void PoseFitter::finish(const Evidence& evidence, const Actor& actor, MapInput input, Hypothesis& fit) {
  const DenseRounds following{config_.policy.dense_rounds, config_.policy.dense_steps};
  const DenseRounds rounds = fit.fresh ? kFirstRounds : following;
  dense_.refine(evidence.samples, Matching::ByParts, actor, input, solver_, rounds, fit.q, fit.summary);
  fit.misfit = dense_.misfit(actor, fit.q);
  judgeBySeen(evidence.markers_world, actor, fit.q, fit.summary);
  input.surface = dense_.matches();
  solver_.expandEvidence(input, fit.q, fit.evidence);
}

std::optional<Hypothesis> PoseFitter::fitFirst(const Evidence& evidence, const BodyAdapter& body) {
  Hypothesis fit;
  fit.fresh = true;
  fit.body = body;
  const GlobalSearch::Result* found = nullptr;
  for (int round = 0; round < kFirstSizeRounds; ++round) {
    const Actor& actor = fit.body->actor();
    found = &global_.find(legs_.complete(evidence.markers_world, actor), searchScale(actor), actor, *database_, search_,
                          prior_builder_, solver_);
    if (!found->found || !fit.body->fitsSize()) break;
    fit.body->rescale(observedSize(evidence, actor, found->q).scale);
  }
  if (!found->found) return std::nullopt;
  fit.q = found->q;
  fit.summary = found->summary;
  const Actor& actor = fit.body->actor();
  judgeBySeen(evidence.markers_world, actor, fit.q, fit.summary);
  if (fit.summary.rms_marker_m > config_.policy.max_rms_m) return std::nullopt;
  const MarkerSet& markers = legs_.complete(evidence.markers_world, actor);
  const MapInput input{actor.skeleton, actor.markers, markers, &global_.prior(), nullptr, nullptr};
  finish(evidence, actor, input, fit);
  return fit;
}

void PoseFitter::judgeBySeen(const MarkerSet& seen_world, const Actor& actor, const Pose& q, MapSummary& summary) {
  if (legs_.supposed()) summary.rms_marker_m = rmsOfSeen(seen_world, actor, q);
}

double PoseFitter::rmsOfSeen(const MarkerSet& seen_world, const Actor& actor, const Pose& q) {
  fk_.update(actor.skeleton, q);
  return MarkerTerm(actor.markers, seen_world, 1, config_.solve.sigma_m).rms(fk_);
}

double PoseFitter::energyOfImage(const MapSummary& fit) const {
  return fit.energy - config_.solve.lambda_smooth * fit.e_smooth - config_.solve.lambda_contact * fit.e_contact;
}

ObservedSize PoseFitter::observedSize(const Evidence& evidence, const Actor& actor, const Pose& q) {
  fk_.update(actor.skeleton, q);
  const SizeEstimate estimate = estimateSize(fk_, actor.markers, evidence.markers_world);
  if (whole_in_view_) {
    const ExtentEvidence extent = dense_.extent(evidence.pixels, actor, q);
    const bool agrees = extent.ratio > kNotLess * estimate.scale;
    if (extent.uprightness >= kUpright && agrees) return {extent.ratio, true};
  }
  const double typical = config_.policy.assumed_stature_m / actor.stature_m();
  return {(estimate.spread_m2 * estimate.scale + kTypical_m2 * typical) / (estimate.spread_m2 + kTypical_m2), false};
}

ShapeEvidence PoseFitter::observedShape(const Hypothesis& fit, const BodyAdapter& body) {
  const MapConfig& solve = config_.solve;
  fk_.update(body.actor().skeleton, fit.q);
  return shapeEvidence(body.shape(), fk_, {dense_.measured(), dense_.outline()},
                       solve.lambda_surface / (2.0 * solve.sigma_surface_m * solve.sigma_surface_m), fit.evidence);
}

}  // namespace depthmocap
