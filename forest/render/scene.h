#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "forest/render/depth_renderer.h"

namespace depthmocap {

// A room around the actor's path in the camera's default world (z towards the camera): floor, back and side walls, and
// a table, a chair, a sofa and a cupboard where the seed puts them, never within reach of the path nor between it and
// the camera. A piece that finds no place is left out.
//   floor_y [m], path: root positions [m] of the actor, at least one.
TriangleMesh makeRoom(double floor_y, const std::vector<Eigen::Vector3d>& path, std::uint64_t seed);

}  // namespace depthmocap
