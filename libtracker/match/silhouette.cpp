#include "libtracker/match/silhouette.h"

#include <algorithm>
#include <limits>

namespace depthmocap {

void Silhouette::observe(const MaskImage& mask) {
  const int width = mask.width / kStep;
  nearest_row_.reset(width, mask.height / kStep, kNone);
  first_column_ = width;
  last_column_ = -1;
  for (int y = 0; y < nearest_row_.height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (mask.at(x * kStep + kStep / 2, y * kStep + kStep / 2) == 0) continue;
      nearest_row_.at(x, y) = static_cast<std::int16_t>(y);
      first_column_ = std::min(first_column_, x);
      last_column_ = std::max(last_column_, x);
    }
  }
  for (int x = first_column_; x <= last_column_; ++x) fillColumn(x);
}

// Each cell learns from the one above, then from the one below where that is nearer.
void Silhouette::fillColumn(int x) {
  for (int y = 1; y < nearest_row_.height; ++y) {
    if (nearest_row_.at(x, y) == kNone) nearest_row_.at(x, y) = nearest_row_.at(x, y - 1);
  }
  for (int y = nearest_row_.height - 2; y >= 0; --y) {
    const std::int16_t above = nearest_row_.at(x, y);
    const std::int16_t below = nearest_row_.at(x, y + 1);
    if (below == kNone || below <= y) continue;
    if (above == kNone || below - y < y - above) nearest_row_.at(x, y) = below;
  }
}

Eigen::Vector2i Silhouette::nearest(int u, int v) const {
  const int x = std::min(u / kStep, nearest_row_.width - 1);
  const int y = std::min(v / kStep, nearest_row_.height - 1);
  int least = std::numeric_limits<int>::max();
  Eigen::Vector2i cell(x, y);
  const auto look = [&](int column) {
    if (column < first_column_ || column > last_column_) return;
    const int row = nearest_row_.at(column, y);
    if (row == kNone) return;
    const int square = (column - x) * (column - x) + (row - y) * (row - y);
    if (square >= least) return;
    least = square;
    cell = {column, row};
  };
  const int farthest = std::max(x - first_column_, last_column_ - x);
  for (int away = 0; away <= farthest && away * away < least; ++away) {
    look(x - away);
    if (away > 0) look(x + away);
  }
  return cell * kStep + Eigen::Vector2i(kStep / 2, kStep / 2);
}

}  // namespace depthmocap
