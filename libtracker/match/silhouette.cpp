#include "libtracker/match/silhouette.h"

#include <algorithm>

namespace depthmocap {
namespace {

constexpr int kFar = 1 << 14;  // [cells]

}  // namespace

// The cell's neighbour may know a nearer one.
void Silhouette::take(int x, int y, int from_x, int from_y) {
  if (!nearest_.contains(from_x, from_y)) return;
  const Eigen::Vector2i here(x, y);
  Eigen::Vector2i& mine = nearest_.at(x, y);
  const Eigen::Vector2i& other = nearest_.at(from_x, from_y);
  if ((other - here).squaredNorm() < (mine - here).squaredNorm()) mine = other;
}

// Two sweeps of vector distances (Danielsson 1980).
void Silhouette::observe(const MaskImage& mask) {
  const int width = mask.width / kStep;
  const int height = mask.height / kStep;
  empty_ = true;
  nearest_.reset(width, height, Eigen::Vector2i(kFar, kFar));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (mask.at(x * kStep + kStep / 2, y * kStep + kStep / 2) == 0) continue;
      nearest_.at(x, y) = {x, y};
      empty_ = false;
    }
  }
  if (empty_) return;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      take(x, y, x, y - 1);
      take(x, y, x - 1, y - 1);
      take(x, y, x + 1, y - 1);
      take(x, y, x - 1, y);
    }
    for (int x = width - 1; x >= 0; --x) take(x, y, x + 1, y);
  }
  for (int y = height - 1; y >= 0; --y) {
    for (int x = width - 1; x >= 0; --x) {
      take(x, y, x, y + 1);
      take(x, y, x - 1, y + 1);
      take(x, y, x + 1, y + 1);
      take(x, y, x + 1, y);
    }
    for (int x = 0; x < width; ++x) take(x, y, x - 1, y);
  }
}

Eigen::Vector2i Silhouette::nearest(int u, int v) const {
  const int x = std::min(u / kStep, nearest_.width - 1);
  const int y = std::min(v / kStep, nearest_.height - 1);
  return nearest_.at(x, y) * kStep + Eigen::Vector2i(kStep / 2, kStep / 2);
}

}  // namespace depthmocap
