#pragma once
#include <Eigen/Core>
#include <array>
#include <vector>

#include "depthmocap/parts.h"
#include "depthmocap/surface_model.h"
#include "libtracker/match/part_points.h"
#include "libtracker/skeleton/forward_kinematics.h"

namespace depthmocap {

// The points of the body's surface that a camera at the origin of the world sees at one pose: those that face it (what
// the body itself hides is not left out). Reuse one object: nothing is allocated after its first calls.
struct PlacedSurface {
  struct Point {
    Eigen::Vector3f p_world;  // [m]
    Eigen::Vector3f n_world;  // unit, outwards
    BonePoint model;          // [m] the same point on its bone, at the actor's size
  };
  std::array<std::vector<Point>, kPartCount> parts;  // index = partIndex(part)
  PartPoints points;                                 // the same, for the search

  // `fk`: the pose; `scale`: size of the actor over the size of the surface model.
  void place(const SurfaceModel& surface, double scale, const ForwardKinematics& fk);
};

}  // namespace depthmocap
