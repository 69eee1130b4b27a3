#include "libtracker/solve/silhouette.h"

#include <algorithm>

namespace depthmocap {
namespace {

constexpr int kFar = 1 << 14;  // [cells]

}  // namespace

// The cell's neighbour may know a nearer one.
void Silhouette::take(int x, int y, int from_x, int from_y) {
  if (from_x < 0 || from_y < 0 || from_x >= width_ || from_y >= height_) return;
  const Eigen::Vector2i here(x, y);
  Eigen::Vector2i& mine = nearest_[static_cast<std::size_t>(y * width_ + x)];
  const Eigen::Vector2i& other = nearest_[static_cast<std::size_t>(from_y * width_ + from_x)];
  if ((other - here).squaredNorm() < (mine - here).squaredNorm()) mine = other;
}

// Two sweeps of vector distances (Danielsson 1980).
void Silhouette::observe(const MaskImage& mask) {
  width_ = mask.width / kStep;
  height_ = mask.height / kStep;
  empty_ = true;
  nearest_.assign(static_cast<std::size_t>(width_ * height_), Eigen::Vector2i(kFar, kFar));
  for (int y = 0; y < height_; ++y) {
    for (int x = 0; x < width_; ++x) {
      if (mask.at(x * kStep + kStep / 2, y * kStep + kStep / 2) == 0) continue;
      nearest_[static_cast<std::size_t>(y * width_ + x)] = {x, y};
      empty_ = false;
    }
  }
  if (empty_) return;
  for (int y = 0; y < height_; ++y) {
    for (int x = 0; x < width_; ++x) {
      take(x, y, x, y - 1);
      take(x, y, x - 1, y - 1);
      take(x, y, x + 1, y - 1);
      take(x, y, x - 1, y);
    }
    for (int x = width_ - 1; x >= 0; --x) take(x, y, x + 1, y);
  }
  for (int y = height_ - 1; y >= 0; --y) {
    for (int x = width_ - 1; x >= 0; --x) {
      take(x, y, x, y + 1);
      take(x, y, x - 1, y + 1);
      take(x, y, x + 1, y + 1);
      take(x, y, x + 1, y);
    }
    for (int x = 0; x < width_; ++x) take(x, y, x - 1, y);
  }
}

Eigen::Vector2i Silhouette::nearest(int u, int v) const {
  const int x = std::min(u / kStep, width_ - 1);
  const int y = std::min(v / kStep, height_ - 1);
  const Eigen::Vector2i& cell = nearest_[static_cast<std::size_t>(y * width_ + x)];
  return cell * kStep + Eigen::Vector2i(kStep / 2, kStep / 2);
}

}  // namespace depthmocap
