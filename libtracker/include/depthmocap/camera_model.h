#pragma once
#include <Eigen/Core>
#include <array>

namespace depthmocap {

// Pinhole camera with Brown-Conrady distortion. Camera frame: x right, y down, z forward, metres.
// Depth images inside the program are already undistorted, so project/unproject are the plain pinhole model.
struct CameraModel {
  int width = 640;                     // [px] (> 0)
  int height = 480;                    // [px] (> 0)
  double fx = 525.0;                   // [px] (> 0)
  double fy = 525.0;                   // [px] (> 0)
  double cx = 319.5;                   // [px]
  double cy = 239.5;                   // [px]
  std::array<double, 5> distortion{};  // k1 k2 p1 p2 k3; all 0 = none

  // Pixel centre (u, v) at depth [m] along the optical axis to p_camera [m].
  [[nodiscard]] Eigen::Vector3d unproject(double u, double v, double depth_m) const {
    return {(u - cx) / fx * depth_m, (v - cy) / fy * depth_m, depth_m};
  }
  // p_camera [m], z > 0, to pixel (u, v).
  [[nodiscard]] Eigen::Vector2d project(const Eigen::Vector3d& p_camera) const {
    return {fx * p_camera.x() / p_camera.z() + cx, fy * p_camera.y() / p_camera.z() + cy};
  }
  [[nodiscard]] bool hasDistortion() const { return distortion != std::array<double, 5>{}; }
};

}  // namespace depthmocap
