#include "libtracker/tracker/hidden_legs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "libtracker/tracker/alignment.h"

namespace depthmocap {
namespace {

// Confidence of a marker that is not seen but supposed: what is seen outweighs it. 0.1 to 0.4 gave alike results on 24
// rendered rooms (docs/tuning.md).
constexpr double kSupposed = 0.2;
constexpr int kFewestOfTrunk = 3;  // seen markers of head, neck, trunk that a leg is supposed below
// [m] By how much sitting must fit better than standing.
constexpr double kStandingBonus_m = 0.1;

// Confidence from which a leg is where its marker is.
constexpr double kPlainlySeen = 0.5;
// [m] Farther from both postures a marker of little confidence is no leg's.
constexpr double kStray_m = 0.3;

constexpr std::array kLegParts = {Part::LeftUpperLeg, Part::RightUpperLeg, Part::LeftLowerLeg, Part::RightLowerLeg};
constexpr std::array kTrunkParts = {Part::Head,          Part::Neck,      Part::Torso,     Part::LeftShoulder,
                                    Part::RightShoulder, Part::LeftWaist, Part::RightWaist};

Pose sitting() {
  Pose q = Pose::Zero();
  q[kRfemurRx] = q[kLfemurRx] = -0.5 * std::numbers::pi;
  q[kRtibiaRx] = q[kLtibiaRx] = 0.5 * std::numbers::pi;
  return q;
}

MarkerSet only(const MarkerSet& markers, std::span<const Part> parts) {
  MarkerSet some = markers;
  some.confidence.setZero();
  for (const Part part : parts) some.confidence[partIndex(part)] = markers.confidence[partIndex(part)];
  return some;
}

}  // namespace

struct HiddenLegs::Guess {
  MarkerSet markers;    // of the whole body
  double misfit_m = 0;  // to what is known of the legs
};

void HiddenLegs::look(bool cut_below, const std::optional<Eigen::Vector4d>& floor_world) {
  cut_below_ = cut_below;
  floor_y_.reset();
  if (floor_world) floor_y_ = -(*floor_world)[3] / (*floor_world)[1];
}

const MarkerSet& HiddenLegs::complete(const MarkerSet& seen_world, const Actor& actor) {
  if (!cut_below_) return seen_world;
  const MarkerSet trunk = only(seen_world, kTrunkParts);
  if (trunk.seenCount() < kFewestOfTrunk) return seen_world;
  const Guess stands = suppose(Pose::Zero(), trunk, seen_world, actor);
  const Guess sits = suppose(sitting(), trunk, seen_world, actor);
  const Guess& guess = sits.misfit_m + kStandingBonus_m < stands.misfit_m ? sits : stands;
  markers_ = seen_world;
  for (const Part part : kLegParts) {
    const int i = partIndex(part);
    if (seen_world.seen(i) && !isStray(seen_world, i, stands, sits)) continue;
    markers_.position.col(i) = guess.markers.position.col(i);
    markers_.confidence[i] = kSupposed;
  }
  return markers_;
}

// Little surface far from where the leg is in either posture: the hem of a coat, or a thing before the lap.
bool HiddenLegs::isStray(const MarkerSet& seen, int part, const Guess& stands, const Guess& sits) {
  const auto away = [&](const Guess& guess) {
    return (seen.position.col(part) - guess.markers.position.col(part)).norm();
  };
  return seen.confidence[part] < kPlainlySeen && std::min(away(stands), away(sits)) > kStray_m;
}

// How legs in this posture agree with the floor and with the thighs and shins that are seen.
HiddenLegs::Guess HiddenLegs::suppose(const Pose& posture, const MarkerSet& trunk, const MarkerSet& seen,
                                      const Actor& actor) {
  Guess guess;
  const Pose q = placedAt(actor, posture, trunk, fk_);
  guess.markers = modelMarkers(actor, q, fk_);
  double known = 0;
  if (floor_y_) {
    const double sole = fk_.position({Bone::LeftFoot, actor.skeleton.left_toe}).y();
    guess.misfit_m += std::abs(sole - *floor_y_);
    known += 1;
  }
  for (const Part part : kLegParts) {
    const int i = partIndex(part);
    if (!seen.seen(i)) continue;
    guess.misfit_m += seen.confidence[i] * (seen.position.col(i) - guess.markers.position.col(i)).norm();
    known += seen.confidence[i];
  }
  if (known > 0) guess.misfit_m /= known;
  return guess;
}

}  // namespace depthmocap
