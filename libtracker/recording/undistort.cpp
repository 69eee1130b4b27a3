#include "libtracker/recording/undistort.h"

#include <Eigen/Core>
#include <cmath>

#include "libtracker/core/check.h"

namespace depthmocap {

namespace {

// Where the lens puts a ray (x, y, 1): normalised image coordinates to the same.
Eigen::Vector2d distorted(const CameraModel& camera, double x, double y) {
  const auto& [k1, k2, p1, p2, k3] = camera.distortion;
  const double r2 = x * x + y * y;
  const double radial = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3));
  return {x * radial + 2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x),
          y * radial + p1 * (r2 + 2.0 * y * y) + 2.0 * p2 * x * y};
}

}  // namespace

std::vector<std::int32_t> undistortionMap(const CameraModel& camera) {
  std::vector<std::int32_t> map;
  map.reserve(static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height));
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const Eigen::Vector2d p = distorted(camera, (u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy);
      const double source_u = std::round(p.x() * camera.fx + camera.cx);
      const double source_v = std::round(p.y() * camera.fy + camera.cy);
      // Written so that NaN, too, is outside.
      const bool inside = source_u >= 0 && source_u < camera.width && source_v >= 0 && source_v < camera.height;
      map.push_back(inside ? static_cast<std::int32_t>(source_v) * camera.width + static_cast<std::int32_t>(source_u)
                           : -1);
    }
  }
  return map;
}

void toMetres(const Image<std::uint16_t>& raw, double depth_unit_m, const std::vector<std::int32_t>& map,
              DepthImage& depth) {
  DMC_CHECK(map.empty() || map.size() == raw.data.size());
  depth.width = raw.width;
  depth.height = raw.height;
  depth.data.resize(raw.data.size());
  for (std::size_t i = 0; i < depth.data.size(); ++i) {
    const std::int32_t source = map.empty() ? static_cast<std::int32_t>(i) : map[i];
    const std::uint16_t steps = source < 0 ? std::uint16_t{0} : raw.data[static_cast<std::size_t>(source)];
    depth.data[i] = static_cast<float>(steps * depth_unit_m);
  }
}

}  // namespace depthmocap
