#pragma once
#include <cstdint>
#include <vector>

#include "forest/train/split_search.h"
#include "libtracker/classify/forest.h"

namespace depthmocap {

// A tree in the making: nodes breadth-first with what was seen in each, so that it can be cut off at any depth.
struct TrainedTree {
  struct Node {
    ForestNode split;  // split.child > 0: has children; 0: a leaf so far
    PartCounts counts{};
    std::int32_t depth = 0;
  };
  std::vector<Node> nodes;
};

// The tree as the classifier uses it, nodes deeper than max_depth cut off. Probabilities of a leaf are rounded to
// `probability_steps` (1 .. 255) steps, which packs better in a file.
ForestTree finishedTree(const TrainedTree& tree, int max_depth, int probability_steps);

}  // namespace depthmocap
