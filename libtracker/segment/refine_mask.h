#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "depthmocap/camera_model.h"
#include "depthmocap/image.h"
#include "libtracker/segment/coarse_cloud.h"
#include "libtracker/segment/components.h"

namespace depthmocap {

// What decides about one pixel beside the coarse answer.
struct RefineLimits {
  double min_depth_m = 0;
  double max_depth_m = 0;
  double gap_m = 0;
  double floor_distance_m = 0;
  std::optional<Eigen::Vector4f> floor;  // camera frame
};

// Pixels of an image, [x0, x1) and [y0, y1).
struct PixelBox {
  int x0 = 0;
  int y0 = 0;
  int x1 = 0;
  int y1 = 0;
};

// Full-resolution mask from the coarse answer: a pixel takes the side of the surrounding cell that is nearest in depth,
// if one lies within the gap; pixels that no cell speaks for (thin fingers) then join neighbours in the mask. `labels`
// holds each cell's component, `selected` 1 for the actor's components. The box holds all of the mask.
PixelBox refineMask(const DepthImage& depth, const CameraModel& camera, const CoarseCloud& cloud,
                    const std::vector<std::int32_t>& labels, const std::vector<std::uint8_t>& selected,
                    const RefineLimits& limits, MaskImage& mask);

}  // namespace depthmocap
