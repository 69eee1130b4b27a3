#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "forest/train/split_search.h"
#include "libtracker/classify/forest.h"
#include "libtracker/core/facing.h"

namespace depthmocap {

// A tree in the making: nodes breadth-first with what was seen in each, so that it can be cut off at any depth.
struct TrainedTree {
  using FacingCounts = std::array<PartCounts, kFacingCount>;

  struct Node {
    ForestNode split;  // split.child > 0: has children; 0: a leaf so far
    PartCounts counts{};
    std::int32_t depth = 0;
  };
  std::vector<Node> nodes;
  // Of a tree that is grown: the samples of every leaf by facing, in the order of the leaves' nodes.
  std::vector<FacingCounts> leaf_counts;
};

// The tree as the classifier uses it, nodes deeper than max_depth cut off; facings 1 or kFacingCount. Probabilities of
// a leaf are rounded to `probability_steps` (1 .. 255) steps, which packs better in a file.
ForestTree finishedTree(const TrainedTree& tree, int max_depth, int facings, int probability_steps);

}  // namespace depthmocap
