#include "libtracker/segment/coarse_cloud.h"

#include <algorithm>

namespace depthmocap {

namespace {

// [cells] Width of the coarse cloud, about. Chosen by hand (docs/tuning.md); with the
// view of a Kinect a cell is 27 mm wide at 4 m.
constexpr int kTargetWidth = 160;
}  // namespace

void buildCoarseCloud(const DepthImage& depth, const CameraModel& camera, double min_depth_m, double max_depth_m,
                      CoarseCloud& cloud) {
  cloud.stride = std::max(1, depth.width / kTargetWidth);
  cloud.offset = cloud.stride / 2;
  cloud.width = (depth.width - cloud.offset + cloud.stride - 1) / cloud.stride;
  cloud.height = (depth.height - cloud.offset + cloud.stride - 1) / cloud.stride;
  cloud.pixel_angle = 2.0 * cloud.stride / (camera.fx + camera.fy);
  cloud.points.assign(cloud.index(0, cloud.height), Eigen::Vector3f::Zero());
  cloud.valid_count = 0;
  for (int cy = 0; cy < cloud.height; ++cy) {
    const int y = cy * cloud.stride + cloud.offset;
    for (int cx = 0; cx < cloud.width; ++cx) {
      const int x = cx * cloud.stride + cloud.offset;
      const auto z = static_cast<double>(depth.at(x, y));
      if (!(z >= min_depth_m && z <= max_depth_m && z > 0)) continue;
      cloud.points[cloud.index(cx, cy)] = camera.unproject(x, y, z).cast<float>();
      ++cloud.valid_count;
    }
  }
}

}  // namespace depthmocap
