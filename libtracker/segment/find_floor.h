#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "libtracker/segment/coarse_cloud.h"
#include "libtracker/segment/depth_noise.h"

namespace depthmocap {

struct Floor {
  Eigen::Vector4f plane = Eigen::Vector4f::Zero();  // n.p + d = 0, |n| = 1, n up, camera above it
  float area_m2 = 0;                                // in view
};

// The floor: the lowest plane within 30 degrees of horizontal, below the camera, by RANSAC (PCL, fixed seed) over the
// cells whose local surface faces upwards and that the room classifier does not take for a person or furniture. Seats,
// tables and beds are no floor: much is measured below them.
class FloorFinder {
 public:
  FloorFinder();
  ~FloorFinder();
  // `shell`: one per cell, logarithm of the odds that it is floor, wall or ceiling. None where no floor is seen.
  std::optional<Floor> find(const CoarseCloud& cloud, const std::vector<float>& shell, double distance_m);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// How far above the floor a point at this depth may still be floor [m]. Depth noise moves a point along its ray, which
// meets the floor at a small angle, so that feet can be told from the floor far away too. `distance_m`: for floors that
// are not flat.
inline float floorTolerance(double distance_m, const Eigen::Vector4f& floor, float depth_m) {
  return static_cast<float>(distance_m) + 3.0F * kDepthNoise_per_m * floor[3] * depth_m;
}

// 1 for each measured cell that is neither floor nor below it.
void keepOffFloor(const CoarseCloud& cloud, const std::optional<Floor>& floor, double distance_m,
                  std::vector<std::uint8_t>& keep);

// Share of the measured cells that lie on the floor plane, [0, 1].
double floorShare(const CoarseCloud& cloud, const Eigen::Vector4f& floor, double distance_m);

}  // namespace depthmocap
