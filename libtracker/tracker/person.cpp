#include "libtracker/tracker/person.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "libtracker/classify/label_image.h"
#include "libtracker/skeleton/facing_of.h"
#include "libtracker/tracker/alignment.h"
#include "libtracker/tracker/joint_confidence.h"
#include "libtracker/tracker/pose_fields.h"

namespace depthmocap {
namespace {

constexpr float kLikelyFacing = 0.001F;  // share from which a side is tried for the first pose
// [energy] Weight of the logarithm of a facing's share. The energy of the solved pose tells the sides apart better: on
// the first frames of 30 real sequences and 12 rendered ones it preferred the right one to the opposite one in 39
// cases.
constexpr double kFacingWeight = 1.5;

// Confidence of head and neck from which nothing else of a body is needed: head and shoulders before the camera.
constexpr double kPlainHead = 0.5;
// Mean confidence of all joints of a first pose in a room, legs that furniture hides among them: piles of things had at
// most 0.198, people in 80 rendered rooms and four real recordings 0.204 and more, or a plain head.
constexpr double kLeastOfBody = 0.2;

}  // namespace

Person::Person(int number, const Models& models, const CameraModel& camera, const TrackerConfig& config,
               const std::optional<Actor>& given)
    : memory(config.policy, given),
      observer(models.classifier, camera, config),
      config_(config),
      camera_(camera),
      fitter_(models.database, memory.actor(), config) {
  out.person = number;
}

const Prediction& Person::predict(const DepthFrame& frame, const UprightWorld& world) {
  R_world_camera_ = world.R_world_camera();
  prediction_ = memory.predict(frame.time_s, R_world_camera_);
  return prediction_;
}

// The method on one page (Su, Chai, Xia 2016); equation numbers as in docs/architecture.md.
void Person::track(const DepthFrame& frame, const PersonRegion& region, const UprightWorld& world, StageClock& clock) {
  begin(frame);
  if (region.pixel_count == 0 && !prediction_.has_pose) return rest(region, world);

  // (1) a body part for each pixel
  observer.label(frame, region, prediction_, evidence_);
  clock.lap(&StageTimes::classify);

  // (2) one marker for each part
  observer.locate(memory.actor().radii_m, &prediction_, R_world_camera_, evidence_);
  clock.lap(&StageTimes::markers);

  // (3) nearest poses in the database, (4) local linear model over them
  fitter_.supposeLegs(region, world);
  if (prediction_.has_pose && enough(region)) fitter_.buildPrior(evidence_, prediction_, memory.actor());
  clock.lap(&StageTimes::prior);

  // (5) maximum a posteriori pose
  fitter_.look(frame.depth, region, camera_, R_world_camera_);
  const std::optional<Hypothesis> pose = fit(region);
  pose ? memory.accept(*pose, prediction_, world.floor()) : memory.miss(prediction_);
  report(region, world, pose);
  clock.lap(&StageTimes::solve);
}

// Nobody is there, and nobody was.
void Person::rest(const PersonRegion& region, const UprightWorld& world) {
  evidence_.pixels.pixels.clear();
  evidence_.markers_camera = {};
  memory.miss(prediction_);
  report(region, world, std::nullopt);
}

void Person::begin(const DepthFrame& frame) {
  out.frame = frame.frame;
  out.time_s = frame.time_s;
  out.reinitialised = false;
  out.solver_iterations = 0;
  out.rms_marker_m = 0;
}

// The pose of this frame, if there is evidence enough for one and it is believed.
std::optional<Hypothesis> Person::fit(const PersonRegion& region) {
  if (!enough(region)) return std::nullopt;
  if (!prediction_.has_pose) {
    std::optional<Hypothesis> first = adopt(fitFromAnySide(evidence_.pixels.facing, memory.body()));
    return first && (!region.in_room || showsABody(*first)) ? first : std::nullopt;
  }
  Hypothesis pose =
      fitter_.fitNext(evidence_, prediction_, memory.actor(), config_.policy.hold_feet ? &memory.contacts() : nullptr);
  if (fitter_.believed(pose) && !fitter_.isPuzzling(pose)) observeBody(pose);
  if (config_.policy.expect_sides) {
    if (std::optional<Hypothesis> other = turnAround(pose)) return adopt(std::move(other));
  }
  if (std::optional<Hypothesis> other = startAnew(pose)) return adopt(std::move(other));
  if (!fitter_.believed(pose)) return std::nullopt;
  return pose;
}

// What a pose that fits says of the body; before other poses are tried.
void Person::observeBody(Hypothesis& pose) {
  if (memory.body().fitsSize()) pose.size = fitter_.observedSize(evidence_, memory.actor(), pose.q);
  if (memory.body().fitsShape() && fitter_.wholeInView()) pose.shape = fitter_.observedShape(pose, memory.body());
}

// Things in rooms that were taken for somebody have no head on a neck where a body would, or little else of a body.
bool Person::showsABody(const Hypothesis& pose) {
  const MarkerSet model = rotated(R_world_camera_.transpose(), modelMarkers(pose.body->actor(), pose.q, fk_));
  const auto confidence = jointConfidence(evidence_.markers_camera, model);
  const double head = std::min(confidence[static_cast<int>(Joint::Head)], confidence[static_cast<int>(Joint::Neck)]);
  return head >= config_.policy.min_head && (head >= kPlainHead || confidence.mean() >= kLeastOfBody);
}

// The image keeps saying that the actor is seen from another side than the pose says: the pose that explains the image
// best decides. None if that is the tracked one.
std::optional<Hypothesis> Person::turnAround(const Hypothesis& tracked) {
  const FacingShares shares = evidence_.pixels.facing_by_image;
  const float share = shares[static_cast<std::size_t>(facingOf(prediction_.q))];
  if (!memory.dispute(share)) return std::nullopt;
  const double tracked_cost = fitter_.energyOfImage(tracked.summary) -
                              kFacingWeight * std::log(static_cast<double>(std::max(share, kLikelyFacing)));
  std::optional<Hypothesis> other = fitFromAnySide(shares, memory.body());
  return other && other->cost < config_.policy.switch_gain * tracked_cost ? other : std::nullopt;
}

// The tracked pose keeps leaving much of the image unexplained: one from this image alone that explains more of it.
// None if there is none.
std::optional<Hypothesis> Person::startAnew(const Hypothesis& tracked) {
  if (!memory.puzzled(fitter_.isPuzzling(tracked))) return std::nullopt;
  std::optional<Hypothesis> other = fitFromAnySide(evidence_.pixels.facing_by_image, memory.body());
  return other && fitter_.explainsMore(*other, tracked) ? other : std::nullopt;
}

// A pose from this image alone. Where the classifier doubts from which side the actor is seen, each likely side is
// tried, and the pose that explains the image best decides; `best_` is then the evidence of its side.
std::optional<Hypothesis> Person::fitFromAnySide(const FacingShares& shares, const BodyAdapter& body) {
  if (!observer.tellsFacings()) {
    best_ = evidence_;
    return fitter_.fitFirst(best_, body);
  }
  std::optional<Hypothesis> found;
  for (std::size_t f = 0; f < kFacingCount; ++f) {
    if (shares[f] < kLikelyFacing) continue;
    const auto facing = static_cast<Facing>(f);
    observer.assume(facing, evidence_, body.actor().radii_m, R_world_camera_, supposed_);
    std::optional<Hypothesis> pose = fitter_.fitFirst(supposed_, body);
    if (!pose) continue;
    pose->facing = facing;
    pose->cost = pose->summary.energy - kFacingWeight * std::log(static_cast<double>(shares[f]));
    if (found && pose->cost >= found->cost) continue;
    found = std::move(pose);
    std::swap(best_, supposed_);
  }
  return found;
}

// The frame is seen from the side that was found; its markers lie as deep as in the body that was found.
std::optional<Hypothesis> Person::adopt(std::optional<Hypothesis> found) {
  if (!found) return found;
  std::swap(evidence_, best_);
  observer.locate(found->body->actor().radii_m, nullptr, R_world_camera_, evidence_);
  return found;
}

bool Person::enough(const PersonRegion& region) const {
  return evidence_.markers_world.seenCount() >= config_.policy.min_markers &&
         region.visible_share >= config_.policy.min_visible;
}

// Fills the result that the caller gets.
void Person::report(const PersonRegion& region, const UprightWorld& world, const std::optional<Hypothesis>& pose) {
  labelImage(evidence_.pixels, region.mask, out.labels);
  out.markers_camera = evidence_.markers_camera;
  out.state = memory.state();
  out.reinitialised = pose && pose->fresh;
  out.R_world_camera = world.R_world_camera();
  out.floor_world = world.floor();
  out.lengths = memory.actor().skeleton.lengths;
  out.stature_m = memory.actor().stature_m();
  out.confidence.setZero();
  if (out.state == TrackState::Lost) return;
  setPose(memory.pose(), memory.actor(), fk_, out);
  if (!pose) return;
  out.confidence = jointConfidence(out.markers_camera, out.model_markers_camera);
  evidence = pose->evidence;
  out.rms_marker_m = pose->summary.rms_marker_m;
  out.solver_iterations = pose->summary.iterations;
}

}  // namespace depthmocap
