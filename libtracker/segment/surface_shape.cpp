#include "libtracker/segment/surface_shape.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <numbers>

#include "libtracker/segment/depth_noise.h"

namespace depthmocap {

namespace {

// Chosen by hand: no comparison of values is on record (docs/tuning.md).

// [cells] Distance between a cell and the four points that span its local plane.
constexpr int kNormalReach = 2;
// [m] Farthest that those points may lie from the cell, up to 3 m of depth; in proportion beyond.
constexpr float kMaxNormalSpan_m = 0.25F;
// Horizontal directions of 15 degrees each that are counted.
constexpr int kDirections = 24;
// Cosine to the vertical above which a cell faces up or down: 37 degrees.
constexpr float kUpwards = 0.8F;
// [cells] With fewer normals a component's roundness is not judged.
constexpr float kMinVotes = 60;

// Votes of a component's cells: horizontal directions, then up.
using Votes = std::array<float, kDirections + 1>;

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

// The fullest 30 degrees, or all that faces up; what was counted is removed.
float takeLargest(Votes& votes) {
  std::size_t best = kDirections;
  float most = votes[kDirections];
  for (std::size_t k = 0; k < kDirections; ++k) {
    const float sum = votes[k] + votes[(k + 1) % kDirections];
    if (sum > most) {
      most = sum;
      best = k;
    }
  }
  votes[best] = 0;
  if (best < kDirections) votes[(best + 1) % kDirections] = 0;
  return most;
}

}  // namespace

void computeNormals(const CoarseCloud& cloud, const std::vector<std::uint8_t>& keep,
                    std::vector<Eigen::Vector3f>& normals) {
  normals.assign(cloud.points.size(), Eigen::Vector3f::Zero());
  for (int y = kNormalReach; y + kNormalReach < cloud.height; ++y) {
    for (int x = kNormalReach; x + kNormalReach < cloud.width; ++x) {
      const std::size_t i = cloud.index(x, y);
      if (keep[i] != 0 && cloud.points[i].z() > 0) normals[i] = cellNormal(cloud, x, y);
    }
  }
}

void measureBoxShares(const std::vector<Eigen::Vector3f>& normals, const ComponentFinder& found,
                      const Eigen::Vector3f& up, std::vector<float>& box_shares) {
  const Eigen::Vector3f ahead = Eigen::Vector3f::UnitX().cross(up).normalized();
  const Eigen::Vector3f side = up.cross(ahead);
  std::vector<Votes> votes(found.components().size(), Votes{});
  for (std::size_t i = 0; i < normals.size(); ++i) {
    if (found.labels()[i] == kNoComponent || normals[i].squaredNorm() == 0) continue;
    Votes& vote = votes[static_cast<std::size_t>(found.labels()[i])];
    const bool upwards = std::abs(normals[i].dot(up)) > kUpwards;
    const float turn = std::atan2(normals[i].dot(side), normals[i].dot(ahead)) / (2 * std::numbers::pi_v<float>)+0.5F;
    const auto direction = static_cast<std::size_t>(turn * kDirections) % kDirections;
    vote[upwards ? static_cast<std::size_t>(kDirections) : direction] += 1.0F;
  }
  box_shares.assign(votes.size(), 0.0F);
  for (std::size_t k = 0; k < votes.size(); ++k) {
    float total = 0;
    for (const float vote : votes[k]) total += vote;
    if (total < kMinVotes) continue;
    const float first = takeLargest(votes[k]);
    box_shares[k] = (first + takeLargest(votes[k])) / total;
  }
}

}  // namespace depthmocap
