#pragma once
#include <cmath>
#include <numbers>

#include "depthmocap/world_frame.h"
#include "forest/render/depth_renderer.h"

namespace depthmocap::testing {

// Looks along -z of the world, as every default world.
inline Eigen::Isometry3d uprightCamera() {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = uprightWorldFromCamera();
  return T;
}

inline TriangleMesh ellipsoid(const Eigen::Vector3d& center, const Eigen::Vector3d& radii, unsigned rings, Part part) {
  TriangleMesh mesh;
  const unsigned around = 2 * rings;
  for (unsigned i = 0; i <= rings; ++i) {
    for (unsigned j = 0; j < around; ++j) {
      const double a = std::numbers::pi * i / rings;
      const double b = std::numbers::pi * j / rings;
      const Eigen::Vector3d unit(std::sin(a) * std::sin(b), std::cos(a), std::sin(a) * std::cos(b));
      mesh.vertices.push_back((center + radii.cwiseProduct(unit)).cast<float>());
    }
  }
  for (unsigned i = 0; i < rings; ++i) {
    for (unsigned j = 0; j < around; ++j) {
      const unsigned k = (j + 1) % around;
      mesh.triangles.push_back({i * around + j, (i + 1) * around + j, i * around + k});
      mesh.triangles.push_back({i * around + k, (i + 1) * around + j, (i + 1) * around + k});
    }
  }
  mesh.part.assign(mesh.triangles.size(), static_cast<std::uint8_t>(part));
  return mesh;
}

// A square of 2 half x 2 half [m] across the optical axis at a distance [m] in front of uprightCamera().
inline TriangleMesh wall(double distance_m, double half_m, double center_x_m = 0.0) {
  TriangleMesh mesh;
  const auto x = static_cast<float>(center_x_m);
  const auto h = static_cast<float>(half_m);
  const auto z = static_cast<float>(-distance_m);
  mesh.vertices = {{x - h, -h, z}, {x + h, -h, z}, {x + h, h, z}, {x - h, h, z}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

inline void setBody(DepthRenderer& renderer, const TriangleMesh& mesh) {
  renderer.setBody(mesh.vertices, mesh.triangles, mesh.part);
}

}  // namespace depthmocap::testing
