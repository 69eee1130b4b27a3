#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

#include "depthmocap/camera_model.h"
#include "depthmocap/image.h"

namespace depthmocap {

// Every stride-th pixel of a depth image as an organised cloud of about 160 x 120 points. Cell (cx, cy) is pixel
// (cx * stride + offset, cy * stride + offset).
struct CoarseCloud {
  int stride = 1;
  int offset = 0;
  int width = 0;                        // [cells]
  int height = 0;                       // [cells]
  double pixel_angle = 0;               // stride / f: a cell at depth z is about z * pixel_angle wide [m]
  std::vector<Eigen::Vector3f> points;  // camera frame [m]; z = 0: no measurement within the depth limits
  int valid_count = 0;

  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
  [[nodiscard]] float cellArea(float depth_m) const {  // [m^2]
    const float side = depth_m * static_cast<float>(pixel_angle);
    return side * side;
  }
  // [m^2] of a plane with this unit normal that the cell of point p covers; of planes seen along it a part is left out.
  [[nodiscard]] float areaAcross(const Eigen::Vector3f& p, const Eigen::Vector3f& normal) const {
    return cellArea(p.z()) / std::max(0.2F, std::abs(normal.dot(p.normalized())));
  }
};

void buildCoarseCloud(const DepthImage& depth, const CameraModel& camera, double min_depth_m, double max_depth_m,
                      CoarseCloud& cloud);

}  // namespace depthmocap
