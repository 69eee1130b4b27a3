#include "libtracker/segment/identity.h"

#include <algorithm>

namespace depthmocap {
namespace {

// Chosen by hand: no comparison of values is on record (docs/tuning.md).

// [m] A point this near in the same cell of the frame before is the same surface: no nearer one is looked for.
constexpr float kSameSurface_m = 0.02F;
// [m] Farthest that a surface moves from frame to frame; cells of a faster hand may stay unknown.
constexpr float kReach_m = 0.08F;
// [cells] The same in the image.
constexpr int kReach = 5;

}  // namespace

Identity IdentityMemory::nearest(const CoarseCloud& cloud, int x, int y) const {
  const Eigen::Vector3f& p = cloud.points[cloud.index(x, y)];
  const auto distance2 = [&](std::size_t i) { return (points_[i] - p).squaredNorm(); };
  const std::size_t same = cloud.index(x, y);
  if (identities_[same] != kUnknown && distance2(same) < kSameSurface_m * kSameSurface_m) {
    return identities_[same];
  }
  Identity answer = kUnknown;
  float best = kReach_m * kReach_m;
  for (int ny = std::max(0, y - kReach); ny <= std::min(cloud.height - 1, y + kReach); ++ny) {
    for (int nx = std::max(0, x - kReach); nx <= std::min(cloud.width - 1, x + kReach); ++nx) {
      const std::size_t i = cloud.index(nx, ny);
      if (identities_[i] == kUnknown) continue;
      const float d = distance2(i);
      if (d >= best) continue;
      best = d;
      answer = identities_[i];
    }
  }
  return answer;
}

// Most of a room is out of everybody's reach, and need not be searched.
void IdentityMemory::markNeighbourhood(const CoarseCloud& cloud) {
  const auto width = static_cast<std::size_t>(cloud.width);
  in_row_.assign(identities_.size(), 0);
  is_near_.assign(identities_.size(), 0);
  for (std::size_t i = 0; i < identities_.size(); ++i) {
    if (identities_[i] == kUnknown) continue;
    const std::size_t x = i % width;
    const std::size_t first = i - std::min<std::size_t>(x, kReach);
    const std::size_t last = i + std::min<std::size_t>(width - 1 - x, kReach);
    std::fill(in_row_.begin() + static_cast<std::ptrdiff_t>(first),
              in_row_.begin() + static_cast<std::ptrdiff_t>(last) + 1, std::uint8_t{1});
  }
  for (int y = 0; y < cloud.height; ++y) {
    for (int ny = std::max(0, y - kReach); ny <= std::min(cloud.height - 1, y + kReach); ++ny) {
      for (int x = 0; x < cloud.width; ++x) is_near_[cloud.index(x, y)] |= in_row_[cloud.index(x, ny)];
    }
  }
}

void IdentityMemory::recall(const CoarseCloud& cloud, std::vector<Identity>& known) {
  known.assign(cloud.points.size(), kUnknown);
  if (identities_.size() != cloud.points.size()) return;
  markNeighbourhood(cloud);
  for (int y = 0; y < cloud.height; ++y) {
    for (int x = 0; x < cloud.width; ++x) {
      const std::size_t i = cloud.index(x, y);
      if (is_near_[i] != 0 && cloud.points[i].z() > 0) known[i] = nearest(cloud, x, y);
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
