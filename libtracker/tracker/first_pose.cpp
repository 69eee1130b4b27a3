// Poses from one image alone: the first one, the first after a loss, and where the image disputes the tracked one.
#include <algorithm>
#include <cmath>

#include "libtracker/classify/classify.h"
#include "libtracker/skeleton/facing_of.h"
#include "libtracker/tracker/alignment.h"
#include "libtracker/tracker/tracker_stages.h"

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

}  // namespace

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

}  // namespace depthmocap
