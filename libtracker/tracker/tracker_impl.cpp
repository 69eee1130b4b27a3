#include "libtracker/tracker/tracker_impl.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "libtracker/classify/label_image.h"
#include "libtracker/skeleton/facing_of.h"
#include "libtracker/tracker/joint_confidence.h"
#include "libtracker/tracker/pose_fields.h"

namespace depthmocap {
namespace {

constexpr float kLikelyFacing = 0.001F;  // share from which a side is tried for the first pose
// [energy] Weight of the logarithm of a facing's share. The energy of the solved pose tells the sides apart better: on
// the first frames of 30 real sequences and 12 rendered ones it preferred the right one to the opposite one in 39
// cases.
constexpr double kFacingWeight = 1.5;

}  // namespace

Tracker::Impl::Impl(const Models& models, const CameraModel& camera, const TrackerConfig& cfg,
                    const std::optional<Actor>& given)
    : config(cfg),
      observer(models.classifier, camera, cfg),
      memory(cfg.policy, given),
      fitter(models.database, memory.actor(), cfg) {}

void Tracker::Impl::begin(const DepthFrame& frame) {
  out.frame = frame.frame;
  out.time_s = frame.time_s;
  out.reinitialised = false;
  out.solver_iterations = 0;
  out.rms_marker_m = 0;
}

// The pose of this frame, if there is evidence enough for one and it is believed.
std::optional<Hypothesis> Tracker::Impl::fit(const PersonRegion& person, const Prediction& prediction) {
  if (!enough(person)) return std::nullopt;
  if (!prediction.has_pose) return adopt(fitFromAnySide(evidence.pixels.facing, memory.size()));
  Hypothesis pose =
      fitter.fitNext(evidence, prediction, memory.actor(), config.policy.hold_feet ? &memory.contacts() : nullptr);
  if (config.policy.expect_sides) {
    if (std::optional<Hypothesis> other = turnAround(pose, prediction)) return adopt(std::move(other));
  }
  if (!fitter.believed(pose.summary)) return std::nullopt;
  if (memory.size().adapting()) pose.observed_scale = fitter.observedScale(evidence, memory.actor(), pose.q);
  return pose;
}

// The image keeps saying that the actor is seen from another side than the pose says: the pose that explains the image
// best decides. None if that is the tracked one.
std::optional<Hypothesis> Tracker::Impl::turnAround(const Hypothesis& tracked, const Prediction& prediction) {
  const FacingShares shares = evidence.pixels.facing_by_image;
  const float share = shares[static_cast<std::size_t>(facingOf(prediction.q))];
  if (!memory.dispute(share)) return std::nullopt;
  const double tracked_cost = fitter.energyOfImage(tracked.summary) -
                              kFacingWeight * std::log(static_cast<double>(std::max(share, kLikelyFacing)));
  std::optional<Hypothesis> other = fitFromAnySide(shares, memory.size());
  return other && other->cost < config.policy.switch_gain * tracked_cost ? other : std::nullopt;
}

// A pose from this image alone. Where the classifier doubts from which side the actor is seen, each likely side is
// tried, and the pose that explains the image best decides; `best` is then the evidence of its side.
std::optional<Hypothesis> Tracker::Impl::fitFromAnySide(const FacingShares& shares, const SizeAdapter& body) {
  if (!observer.tellsFacings()) {
    best = evidence;
    return fitter.fitFirst(best, body);
  }
  std::optional<Hypothesis> found;
  for (std::size_t f = 0; f < kFacingCount; ++f) {
    if (shares[f] < kLikelyFacing) continue;
    const auto facing = static_cast<Facing>(f);
    observer.assume(facing, evidence, body.actor().radii_m, world.R_world_camera(), supposed);
    std::optional<Hypothesis> pose = fitter.fitFirst(supposed, body);
    if (!pose) continue;
    pose->facing = facing;
    pose->cost = pose->summary.energy - kFacingWeight * std::log(static_cast<double>(shares[f]));
    if (found && pose->cost >= found->cost) continue;
    found = std::move(pose);
    std::swap(best, supposed);
  }
  return found;
}

// The frame is seen from the side that was found; its markers lie as deep as in the body that was found.
std::optional<Hypothesis> Tracker::Impl::adopt(std::optional<Hypothesis> found) {
  if (!found) return found;
  std::swap(evidence, best);
  observer.locate(found->body->actor().radii_m, nullptr, world.R_world_camera(), evidence);
  return found;
}

bool Tracker::Impl::enough(const PersonRegion& person) const {
  return evidence.markers_world.seenCount() >= config.policy.min_markers &&
         person.visible_share >= config.policy.min_visible;
}

// Fills the result that the caller gets.
void Tracker::Impl::report(const PersonRegion& person, const std::optional<Hypothesis>& pose) {
  labelImage(evidence.pixels, person.mask, out.labels);
  out.markers_camera = evidence.markers_camera;
  out.state = memory.state();
  out.reinitialised = pose && pose->fresh;
  out.R_world_camera = world.R_world_camera();
  out.floor_world = world.floor();
  out.lengths = memory.actor().skeleton.lengths;
  out.stature_m = memory.actor().stature_m();
  out.confidence.setZero();
  if (out.state == TrackState::Lost) return;
  setPose(memory.pose(), memory.actor(), fk, out);
  if (!pose) return;
  out.confidence = jointConfidence(out.markers_camera, out.model_markers_camera);
  out.rms_marker_m = pose->summary.rms_marker_m;
  out.solver_iterations = pose->summary.iterations;
}

}  // namespace depthmocap
