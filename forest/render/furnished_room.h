#pragma once
#include <Eigen/Core>
#include <span>
#include <vector>

#include "depthmocap/pose.h"
#include "forest/render/depth_renderer.h"
#include "forest/render/scene_kind.h"
#include "libtracker/core/random.h"
#include "libtracker/skeleton/skeleton.h"

namespace depthmocap {

// Whom a room is furnished around. World: y up, the camera at the origin, which looks along -z.
struct RoomPeople {
  double floor_y = -1;                  // [m] (< 0)
  const Skeleton* skeleton = nullptr;   // of the actor
  std::span<const Pose> actor;          // poses from which to keep clear; none: nobody is there
  std::vector<Eigen::Vector3d> others;  // [m] joints of other people, likewise
  double distance_m = 2.7;              // [m] from the camera to where the actor would be
};

// A room of random size with furniture, none of which anybody passes through or is hidden behind, but for what `kind`
// places at the actor: a seat that fits where the actor sits (otherwise close behind), a table close before, a sofa in
// between. Cluttered rooms hide legs now and then. A piece that finds no place is left out. kind: a furnished room.
TriangleMesh makeFurnishedRoom(SceneKind kind, const RoomPeople& people, Random& random);

}  // namespace depthmocap
