#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "libtracker/segment/coarse_cloud.h"
#include "libtracker/segment/depth_noise.h"

namespace depthmocap {

// A bounded vertical plane, camera frame: n.p + d = 0, |n| = 1, over `low`..`high` [m] along `along` (horizontal in the
// wall). Bounded, so that a cupboard's front does not cut a person who stands beside it.
struct Wall {
  Eigen::Vector4f plane = Eigen::Vector4f::Zero();
  Eigen::Vector3f along = Eigen::Vector3f::Zero();
  float low = 0;
  float high = 0;
};

struct RoomPlanes {
  std::optional<Eigen::Vector4f> floor;  // n up, camera above it
  float floor_area_m2 = 0;               // in view
  std::vector<Wall> walls;
};

// The largest planes of a room: the floor (lowest plane within 30 degrees of horizontal, below the camera) and up to
// three walls, by RANSAC (PCL, fixed seed) over the cells whose local surface faces the right way.
class PlaneFinder {
 public:
  PlaneFinder();
  ~PlaneFinder();
  void find(const CoarseCloud& cloud, double distance_m, RoomPlanes& planes);

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

// 1 for each cell that is neither floor (or below it) nor wall.
void keepOffPlanes(const CoarseCloud& cloud, const RoomPlanes& planes, double distance_m,
                   std::vector<std::uint8_t>& keep);

// Share of the measured cells that lie on the floor plane, [0, 1].
double floorShare(const CoarseCloud& cloud, const Eigen::Vector4f& floor, double distance_m);

}  // namespace depthmocap
