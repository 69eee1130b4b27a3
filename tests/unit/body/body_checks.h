#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "libtracker/body/body_surface.h"

namespace depthmocap {

// Number of directed edges without their opposite, or met more than once: 0 for a closed, consistently turned surface.
inline std::size_t openEdges(const BodySurface& body) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const auto& t : body.triangles) {
    for (std::size_t i = 0; i < 3; ++i) ++edges[{t[i], t[(i + 1) % 3]}];
  }
  std::size_t open = 0;
  for (const auto& [edge, count] : edges) {
    const auto opposite = edges.find({edge.second, edge.first});
    if (count != 1 || opposite == edges.end()) ++open;
  }
  return open;
}

// Winding number of the surface around a point: 1 inside, 0 outside (Van Oosterom and Strackee 1983).
inline double windingNumber(const BodySurface& body, const Eigen::Vector3d& p) {
  double sum = 0;
  for (const auto& t : body.triangles) {
    const Eigen::Vector3d a = body.vertices[t[0]].cast<double>() - p;
    const Eigen::Vector3d b = body.vertices[t[1]].cast<double>() - p;
    const Eigen::Vector3d c = body.vertices[t[2]].cast<double>() - p;
    const double la = a.norm();
    const double lb = b.norm();
    const double lc = c.norm();
    const double numerator = a.x() * (b.y() * c.z() - b.z() * c.y()) + a.y() * (b.z() * c.x() - b.x() * c.z()) +
                             a.z() * (b.x() * c.y() - b.y() * c.x());
    sum += 2.0 * std::atan2(numerator, la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return sum / (4.0 * 3.14159265358979323846);
}

inline double heightOf(const BodySurface& body) {
  float low = 1e9F;
  float high = -1e9F;
  for (const auto& v : body.vertices) {
    low = std::min(low, v.y());
    high = std::max(high, v.y());
  }
  return static_cast<double>(high - low);
}

inline double kilogramsOf(const BodySurface& body) {
  return enclosedVolume(body.vertices, body.triangles) * 1e3 * kBodyDensityKgPerLitre;
}

}  // namespace depthmocap
