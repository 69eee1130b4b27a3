#include "libtracker/body/body_surface.h"

#include <Eigen/Geometry>

namespace depthmocap {

double enclosedVolume(const std::vector<Eigen::Vector3f>& vertices,
                      const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  double six_volumes = 0;
  for (const auto& t : triangles) {
    const Eigen::Vector3d a = vertices[t[0]].cast<double>();
    const Eigen::Vector3d b = vertices[t[1]].cast<double>();
    six_volumes += a.dot(b.cross(vertices[t[2]].cast<double>()));
  }
  return six_volumes / 6.0;
}

std::vector<Eigen::Vector3f> vertexNormals(const std::vector<Eigen::Vector3f>& vertices,
                                           const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  std::vector<Eigen::Vector3f> normals(vertices.size(), Eigen::Vector3f::Zero());
  for (const auto& t : triangles) {
    const Eigen::Vector3f n = (vertices[t[1]] - vertices[t[0]]).cross(vertices[t[2]] - vertices[t[0]]);
    for (const std::uint32_t v : t) normals[v] += n;
  }
  for (Eigen::Vector3f& n : normals) {
    const float length = n.norm();
    if (length > 0) n /= length;
  }
  return normals;
}

}  // namespace depthmocap
