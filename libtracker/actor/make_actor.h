#pragma once
#include <array>
#include <memory>

#include "depthmocap/actor.h"
#include "libtracker/actor/body_template.h"

namespace depthmocap {

// A body with these bone lengths and an average body's marker offsets and radii. `surface`: its skin; without one the
// average body's, which the library holds once.
Actor averageActor(const BoneLengths& lengths);
Actor averageActor(const BoneLengths& lengths, std::shared_ptr<const SurfaceModel> surface);

// A body of this shape of the average template, as it is fitted while tracking: with an average body's marker offsets
// and radii.
Actor shapedActor(const ShapeVector& shape);

// A measured body: bone lengths, girths and surface by the measurement's shape, an average body's marker offsets, part
// radii that follow the girths.
Actor measuredActor(const ActorMeasurement& measured);

// The skin of a measured body.
std::shared_ptr<const SurfaceModel> surfaceOf(const ActorMeasurement& measured);

// The same body `factor` times as large; depth_scale and fit stay as they are. The actor must be a measured one.
Actor scaledActor(const Actor& actor, double factor);

// The radii of an actor file.
struct LimbRadius {
  const char* name;
  double ActorMeasurement::*field;
};
inline constexpr std::array<LimbRadius, 6> kLimbRadii = {{
    {"upper_arm", &ActorMeasurement::upper_arm_radius_m},
    {"lower_arm", &ActorMeasurement::lower_arm_radius_m},
    {"upper_leg", &ActorMeasurement::upper_leg_radius_m},
    {"lower_leg", &ActorMeasurement::lower_leg_radius_m},
    {"torso_half_width", &ActorMeasurement::torso_half_width_m},
    {"torso_half_depth", &ActorMeasurement::torso_half_depth_m},
}};

}  // namespace depthmocap
