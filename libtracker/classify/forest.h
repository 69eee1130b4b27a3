#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "depthmocap/parts.h"
#include "libtracker/core/facing.h"

namespace depthmocap {

// Random decision forest over depth-difference features (Shotton 2011):
//   f(x; u, v) = d(x + u/d(x)) - d(x + v/d(x)),  left where f < threshold.
// Offsets u, v are [px * m] for a focal length of kReferenceFocal_px; inference scales them by the camera's fx, so one
// forest serves every camera. A probe outside the actor (background, no measurement, outside the image) reads
// kBackgroundDepth_m.
inline constexpr float kReferenceFocal_px = 525.0F;
inline constexpr float kBackgroundDepth_m = 10.0F;

struct ForestNode {
  std::array<std::int16_t, 2> u{};  // [px * m] x, y
  std::array<std::int16_t, 2> v{};
  float threshold_m = 0;   // [m] a whole number of millimetres
  std::int32_t child = 0;  // > 0: index of the left child, the right one follows it; <= 0: -index of the leaf
};

// What a leaf says for one facing. Rows of leaves and of votes have one value more than there are parts, always 0, so
// that they fill whole vectors.
inline constexpr std::size_t kPartLanes = 16;
static_assert(kPartLanes > kPartCount);
using LeafRow = std::array<std::uint8_t, kPartLanes>;
using VoteRow = std::array<std::uint16_t, kPartLanes>;

struct ForestTree {
  std::vector<ForestNode> nodes;  // nodes[0] is the root
  // Each leaf has as many rows as the forest has facings: leaf i begins at leaves[i * facings]. Its rows together are
  // the distribution * 255 of part and facing, as if every facing were equally frequent.
  std::vector<LeafRow> leaves;
};

struct Forest {
  std::vector<ForestTree> trees;
  std::string origin;  // one line: data
  int facings = 1;     // kFacingCount, or 1: leaves do not tell the facings apart
};

// Throws std::logic_error where the forest is not one: no tree, no such number of facings, an index out of range, a
// node that is not reached exactly once from its root (so no cycle), a leaf without any probability.
void checkForest(const Forest& forest);

// Nodes on the longest way from the root to a leaf, less one: 0 for a tree that is a single leaf.
int treeDepth(const ForestTree& tree);

}  // namespace depthmocap
