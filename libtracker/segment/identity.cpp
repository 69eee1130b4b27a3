#include "libtracker/segment/identity.h"

#include <algorithm>
#include <limits>

namespace depthmocap {
namespace {

// Chosen by hand: no comparison of values is on record (docs/tuning.md).

// [m] A point this near in the same cell of the frame before is the same surface: no nearer one is looked for.
constexpr float kSameSurface_m = 0.02F;
// [m] Farthest that a surface moves from frame to frame; cells of a faster hand may stay unknown.
constexpr float kReach_m = 0.08F;
// [cells] The same in the image.
constexpr int kReach = 5;
// Share of the distance of two rays that is surely between points on them: columns and rows may have two focal lengths.
constexpr float kSureShare = 0.9F;

}  // namespace

// Ring by ring around the cell, until a ring is farther away than what was found: r cells beside a point every point is
// at least the distance of the rays away, which is z^2 / |p| times their difference in slope.
Identity IdentityMemory::nearest(const CoarseCloud& cloud, int x, int y) const {
  const Eigen::Vector3f& p = cloud.points[cloud.index(x, y)];
  const float apart_m = kSureShare * p.z() * p.z() * static_cast<float>(cloud.pixel_angle) / p.norm();
  Identity answer = kUnknown;
  float best = kReach_m * kReach_m;
  const auto visit = [&](int nx, int ny) {
    if (nx < 0 || ny < 0 || nx >= cloud.width || ny >= cloud.height) return;
    const std::size_t i = cloud.index(nx, ny);
    if (identities_[i] == kUnknown) return;
    const float d = (points_[i] - p).squaredNorm();
    if (d >= best) return;
    best = d;
    answer = identities_[i];
  };
  visit(x, y);
  if (best < kSameSurface_m * kSameSurface_m) return answer;
  for (int r = 1; r <= kReach; ++r) {
    const float least = apart_m * static_cast<float>(r);
    if (least * least >= best) break;
    for (int k = -r; k <= r; ++k) visit(x + k, y - r);
    for (int k = 1 - r; k < r; ++k) {
      visit(x - r, y + k);
      visit(x + r, y + k);
    }
    for (int k = -r; k <= r; ++k) visit(x + k, y + r);
  }
  return answer;
}

// The cells within reach of one that is known: most of a room is out of everybody's reach, and need not be searched.
IdentityMemory::CellBox IdentityMemory::boxOfKnown(const CoarseCloud& cloud) const {
  CellBox box{cloud.width, cloud.height, 0, 0};
  for (int y = 0; y < cloud.height; ++y) {
    for (int x = 0; x < cloud.width; ++x) {
      if (identities_[cloud.index(x, y)] == kUnknown) continue;
      box = {std::min(box.x0, x), std::min(box.y0, y), std::max(box.x1, x + 1), std::max(box.y1, y + 1)};
    }
  }
  return {std::max(0, box.x0 - kReach), std::max(0, box.y0 - kReach), std::min(cloud.width, box.x1 + kReach),
          std::min(cloud.height, box.y1 + kReach)};
}

void IdentityMemory::findDepthsAround(const CoarseCloud& cloud, const CellBox& box) {
  const DepthRange nothing{std::numeric_limits<float>::max(), std::numeric_limits<float>::lowest()};
  in_row_.assign(identities_.size(), nothing);
  around_.assign(identities_.size(), nothing);
  for (int y = box.y0; y < box.y1; ++y) {
    for (int x = box.x0; x < box.x1; ++x) {
      const std::size_t i = cloud.index(x, y);
      if (identities_[i] == kUnknown) continue;
      const float z = points_[i].z();
      for (int k = std::max(-kReach, -x); k <= std::min(kReach, cloud.width - 1 - x); ++k) {
        in_row_[cloud.index(x + k, y)].include({z, z});
      }
    }
  }
  for (int y = box.y0; y < box.y1; ++y) {
    for (int ny = std::max(box.y0, y - kReach); ny <= std::min(box.y1 - 1, y + kReach); ++ny) {
      for (int x = box.x0; x < box.x1; ++x) around_[cloud.index(x, y)].include(in_row_[cloud.index(x, ny)]);
    }
  }
}

void IdentityMemory::recall(const CoarseCloud& cloud, std::vector<Identity>& known) {
  known.assign(cloud.points.size(), kUnknown);
  if (identities_.size() != cloud.points.size()) return;
  const CellBox box = boxOfKnown(cloud);
  findDepthsAround(cloud, box);
  for (int y = box.y0; y < box.y1; ++y) {
    for (int x = box.x0; x < box.x1; ++x) {
      const std::size_t i = cloud.index(x, y);
      const float z = cloud.points[i].z();
      const bool in_reach = z > around_[i].near_m - kReach_m && z < around_[i].far_m + kReach_m;
      if (in_reach && z > 0) known[i] = nearest(cloud, x, y);
    }
  }
}

void IdentityMemory::remember(const CoarseCloud& cloud, const std::vector<std::int32_t>& labels,
                              const std::vector<Identity>& identities) {
  points_ = cloud.points;
  identities_.assign(labels.size(), kUnknown);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (labels[i] >= 0) identities_[i] = identities[static_cast<std::size_t>(labels[i])];
  }
}

}  // namespace depthmocap
