#include "libtracker/actor/make_actor.h"

#include <utility>

#include "depthmocap/error.h"
#include "libtracker/actor/template_surface.h"
#include "libtracker/core/check.h"
#include "libtracker/skeleton/marker_model.h"
#include "libtracker/skeleton/skeleton.h"

namespace depthmocap {
namespace {

constexpr double kShortest_m = 1.0;  // statures of an adult that nobody is outside of
constexpr double kTallest_m = 2.2;

// Which girth goes with each part's radius.
Girth girthOfPart(Part part) {
  switch (mirrored(part) >= part ? part : mirrored(part)) {
    case Part::Head:
      return Girth::Head;
    case Part::Neck:
      return Girth::Neck;
    case Part::LeftShoulder:
      return Girth::Shoulder;
    case Part::LeftUpperArm:
      return Girth::UpperArm;
    case Part::LeftLowerArm:
      return Girth::LowerArm;
    case Part::LeftWaist:
      return Girth::WaistDepth;
    case Part::LeftUpperLeg:
      return Girth::UpperLeg;
    case Part::LeftLowerLeg:
      return Girth::LowerLeg;
    default:
      return Girth::TorsoDepth;
  }
}

}  // namespace

Actor averageActor(const BoneLengths& lengths) {
  static const auto surface = std::make_shared<const SurfaceModel>(shippedBodies().average.surface);
  return averageActor(lengths, surface);
}

Actor averageActor(const BoneLengths& lengths, std::shared_ptr<const SurfaceModel> surface) {
  Actor actor;
  actor.skeleton = makeSkeleton(lengths);
  actor.markers = averageMarkerModel(actor.skeleton);
  actor.radii_m = averagePartRadii(actor.skeleton);
  actor.surface = std::move(surface);
  return actor;
}

Actor shapedActor(const ShapeVector& shape) {
  return averageActor(boneLengths(shape), std::make_shared<const SurfaceModel>(BodyTemplate::average().surface(shape)));
}

Actor averageActor(double stature_m) {
  if (!(stature_m >= kShortest_m && stature_m <= kTallest_m)) {
    throw Error("a stature must lie between 1.0 and 2.2 m", "averageActor");
  }
  return averageActor(averageBoneLengths(stature_m));
}

std::shared_ptr<const SurfaceModel> surfaceOf(const ActorMeasurement& measured) {
  return std::make_shared<const SurfaceModel>(BodyTemplate::ofSex(measured.sex).surface(measured.shape));
}

Actor measuredActor(const ActorMeasurement& measured) {
  Actor actor = averageActor(boneLengths(measured.shape), surfaceOf(measured));
  const double average = BodyTemplate::ofSex(measured.sex).girthOf(actor.stature_m());
  for (std::size_t i = 0; i < kPartCount; ++i) {
    const auto girth = static_cast<Eigen::Index>(girthOfPart(partAt(static_cast<int>(i))));
    actor.radii_m[i] *= measured.shape[kBoneLengthCount + girth] / average;
  }
  actor.measured = std::make_shared<const ActorMeasurement>(measured);
  return actor;
}

Actor scaledActor(const Actor& actor, double factor) {
  DMC_CHECK(actor.measured != nullptr);
  ActorMeasurement measured = *actor.measured;
  measured.shape *= factor;
  for (const LimbRadius& radius : kLimbRadii) measured.*radius.field *= factor;
  Actor scaled = actor;
  scaled.skeleton = makeSkeleton(boneLengths(measured.shape));
  for (BonePoint& marker : scaled.markers) marker.p_bone *= factor;
  for (double& radius : scaled.radii_m) radius *= factor;
  scaled.surface = surfaceOf(measured);
  scaled.measured = std::make_shared<const ActorMeasurement>(std::move(measured));
  return scaled;
}

Actor asSeen(const Actor& actor) {
  return actor.measured ? scaledActor(actor, 1.0 / actor.measured->depth_scale) : actor;
}

}  // namespace depthmocap
