#include "libtracker/segment/boards.h"

#include <algorithm>

#include "libtracker/segment/depth_noise.h"

namespace depthmocap {
namespace {

// [m] Standard deviation across the surface of a door or the front of a cupboard, to which depth noise adds
// (kDepthNoise_per_m); a body's is 4 cm and more.
constexpr float kPanelThickness_m = 0.012F;
// Share of the measured cells from which a piece is large. Chosen by hand: no comparison of values is on record.
constexpr double kLargeShare = 0.15;

// Nothing is measured any more in the pixels that a cell stands for.
void clearCell(const CoarseCloud& cloud, int cx, int cy, DepthImage& depth) {
  const int x0 = cx * cloud.stride;
  const int y0 = cy * cloud.stride;
  for (int y = y0; y < std::min(depth.height, y0 + cloud.stride); ++y) {
    for (int x = x0; x < std::min(depth.width, x0 + cloud.stride); ++x) depth.at(x, y) = 0;
  }
}

}  // namespace

bool isPanel(const Component& component) {
  return component.thickness_m < kPanelThickness_m + kDepthNoise_per_m * component.mean.z() * component.mean.z();
}

bool isLarge(const Component& component, const CoarseCloud& cloud) {
  return component.cells >= kLargeShare * cloud.valid_count;
}

int findBoards(const CoarseCloud& cloud, const std::vector<Component>& components,
               std::vector<std::uint8_t>& is_board) {
  is_board.assign(components.size(), 0);
  const Component* main = nullptr;
  for (const Component& c : components) {
    if (!isPanel(c) && (main == nullptr || c.cells > main->cells)) main = &c;
  }
  int cells = 0;
  for (std::size_t k = 0; main != nullptr && k < components.size(); ++k) {
    const Component& c = components[k];
    if (!isPanel(c) || !isLarge(c, cloud) || c.mean.z() >= main->mean.z()) continue;
    is_board[k] = 1;
    cells += c.cells;
  }
  return cells;
}

void takeAwayBoards(const DepthImage& depth, const CoarseCloud& cloud, const ComponentFinder& pieces,
                    const std::vector<std::uint8_t>& is_board, DepthImage& without) {
  without = depth;
  for (int cy = 0; cy < cloud.height; ++cy) {
    for (int cx = 0; cx < cloud.width; ++cx) {
      const std::int32_t label = pieces.labels()[cloud.index(cx, cy)];
      if (label != kNoComponent && is_board[static_cast<std::size_t>(label)] != 0) clearCell(cloud, cx, cy, without);
    }
  }
}

}  // namespace depthmocap
