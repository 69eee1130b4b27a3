#include "tests/accuracy/disturbance.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace depthmocap {
namespace {

// How far a pixel lies from the side that the board comes from [px].
int reach(const Disturbance& d, const DepthImage& depth, int x, int y) {
  if (d.occluder == "below") return depth.height - 1 - y;
  return d.occluder == "left" ? x : depth.width - 1 - x;
}

template <typename Visit>
void forEachPixel(DepthImage& depth, Visit&& visit) {
  for (int y = 0; y < depth.height; ++y) {
    for (int x = 0; x < depth.width; ++x) visit(x, y, depth.at(x, y));
  }
}

// The board reaches just far enough to hide the wanted share of what was measured.
void putBoard(const Disturbance& d, DepthImage& depth) {
  std::vector<int> reaches;
  forEachPixel(depth, [&](int x, int y, float z) {
    if (z > 0) reaches.push_back(reach(d, depth, x, y));
  });
  if (reaches.empty()) return;
  const auto hidden = static_cast<std::size_t>(d.occluded_share * static_cast<double>(reaches.size()));
  const auto edge = reaches.begin() + static_cast<std::ptrdiff_t>(hidden);
  std::nth_element(reaches.begin(), edge, reaches.end());
  const int length = *edge;
  forEachPixel(depth, [&](int x, int y, float& z) {
    if (reach(d, depth, x, y) < length) z = static_cast<float>(d.board_m);
  });
}

}  // namespace

void disturb(const Disturbance& disturbance, DepthFrame& frame) {
  if (frame.frame >= disturbance.first_blank && frame.frame <= disturbance.last_blank) {
    std::fill(frame.depth.data.begin(), frame.depth.data.end(), 0.0F);
  } else if (disturbance.occluded_share > 0) {
    putBoard(disturbance, frame.depth);
  }
}

}  // namespace depthmocap
