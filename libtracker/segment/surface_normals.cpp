#include "libtracker/segment/surface_normals.h"

#include <Eigen/Geometry>
#include <cmath>

#include "libtracker/segment/depth_noise.h"

namespace depthmocap {

namespace {

// Chosen by hand: no comparison of values is on record (docs/tuning.md).

// [cells] Distance between a cell and the four points that span its local plane.
constexpr int kNormalReach = 2;
// [m] Farthest that those points may lie from the cell, up to 3 m of depth; in proportion beyond.
constexpr float kMaxNormalSpan_m = 0.25F;

Eigen::Vector3f cellNormal(const CoarseCloud& cloud, int x, int y) {
  const Eigen::Vector3f& p = cloud.points[cloud.index(x, y)];
  const Eigen::Vector3f& left = cloud.points[cloud.index(x - kNormalReach, y)];
  const Eigen::Vector3f& right = cloud.points[cloud.index(x + kNormalReach, y)];
  const Eigen::Vector3f& above = cloud.points[cloud.index(x, y - kNormalReach)];
  const Eigen::Vector3f& below = cloud.points[cloud.index(x, y + kNormalReach)];
  const float span = kMaxNormalSpan_m * gapGrowth(p.z());
  for (const Eigen::Vector3f* q : {&left, &right, &above, &below}) {
    if (!(q->z() > 0) || (*q - p).squaredNorm() > span * span) return Eigen::Vector3f::Zero();
  }
  const Eigen::Vector3f normal = (below - above).cross(right - left);
  const float length = normal.norm();
  if (!(length > 0)) return Eigen::Vector3f::Zero();
  return normal.dot(p) > 0 ? Eigen::Vector3f(-normal / length) : Eigen::Vector3f(normal / length);
}

}  // namespace

void computeNormals(const CoarseCloud& cloud, std::vector<Eigen::Vector3f>& normals) {
  normals.assign(cloud.points.size(), Eigen::Vector3f::Zero());
  for (int y = kNormalReach; y + kNormalReach < cloud.height; ++y) {
    for (int x = kNormalReach; x + kNormalReach < cloud.width; ++x) {
      const std::size_t i = cloud.index(x, y);
      if (cloud.points[i].z() > 0) normals[i] = cellNormal(cloud, x, y);
    }
  }
}

}  // namespace depthmocap
