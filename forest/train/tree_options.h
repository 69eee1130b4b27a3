#pragma once
#include <cstddef>
#include <cstdint>

#include "forest/train/split_search.h"

namespace depthmocap {

// How one tree is grown.
struct TreeOptions {
  FeatureOptions features;
  int depth = 19;                        // (>= 1) of the tree
  std::uint32_t pixels_per_image = 300;  // (>= 1)
  int candidates = 400;                  // (>= 1) features tried a node; small nodes try a part of them
  std::uint32_t min_leaf = 8;            // (>= 1) samples in a leaf
  std::size_t max_nodes = 400000;        // (>= 3)
  int facing_weight = 3;                 // [1/8] (0 .. 64) of the facing's entropy beside the parts' given the facing
  std::uint32_t node_samples = 100000;   // (>= 2) a node with more chooses its split on an even selection of them
  std::uint32_t batch_samples = 1U << 20U;  // (>= node_samples) whose probes are in memory at one time
  void validate() const;                    // throws Error naming field, value and rule
};

}  // namespace depthmocap
