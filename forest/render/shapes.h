#pragma once
#include <Eigen/Geometry>
#include <array>
#include <cstdint>

#include "forest/render/depth_renderer.h"

namespace depthmocap {

// A box with its edges along the axes of some frame [m].
struct Box {
  Eigen::Vector3d low;
  Eigen::Vector3d high;
};

// Two triangles; corners counter-clockwise from outside, in the world [m].
void addQuad(TriangleMesh& mesh, const std::array<Eigen::Vector3d, 4>& corners);
void addBox(TriangleMesh& mesh, const Box& box, const Eigen::Isometry3d& T_world_box);
// A superquadric (Barr 1981) about the origin of T_world_thing, `half` [m] its half extents: roundness 1 is an
// ellipsoid, towards 0 a box.
void addSuperquadric(TriangleMesh& mesh, const Eigen::Isometry3d& T_world_thing, const Eigen::Vector3d& half,
                     double roundness);
// Gives all triangles that have no part yet this one.
void fillParts(TriangleMesh& mesh, std::uint8_t part);

Eigen::Isometry3d placed(const Eigen::Matrix3d& R, const Eigen::Vector3d& p);
Eigen::Matrix3d aboutY(double angle);  // [rad]

}  // namespace depthmocap
