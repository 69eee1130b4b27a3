#pragma once
#include <array>

#include "libtracker/skeleton/marker_model.h"
#include "libtracker/skeleton/skeleton.h"

namespace depthmocap {

// The body being tracked: skeleton s, marker offsets v and part radii.
struct ActorModel {
  Skeleton skeleton;
  MarkerModel markers;
  std::array<double, kPartCount> radii_m{};
};

inline ActorModel averageActor(const BoneLengths& lengths) {
  ActorModel actor;
  actor.skeleton = makeSkeleton(lengths);
  actor.markers = averageMarkerModel(actor.skeleton);
  actor.radii_m = averagePartRadii(actor.skeleton);
  return actor;
}

}  // namespace depthmocap
