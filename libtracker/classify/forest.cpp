#include "libtracker/classify/forest.h"

#include <algorithm>

#include "libtracker/core/check.h"

namespace depthmocap {
namespace {

bool hasProbability(const ForestTree& tree, std::size_t leaf, std::size_t facings) {
  for (std::size_t row = leaf * facings; row < (leaf + 1) * facings; ++row) {
    if (tree.leaves[row] != LeafRow{}) return true;
  }
  return false;
}

void checkTree(const ForestTree& tree, std::size_t facings) {
  DMC_CHECK(!tree.nodes.empty() && tree.leaves.size() % facings == 0);
  const std::size_t leaf_count = tree.leaves.size() / facings;
  std::vector<bool> reached(tree.nodes.size(), false);
  reached[0] = true;
  std::size_t reached_count = 1;
  std::vector<std::size_t> open{0};
  while (!open.empty()) {
    const ForestNode& node = tree.nodes[open.back()];
    open.pop_back();
    if (node.child <= 0) {
      DMC_CHECK(static_cast<std::size_t>(-static_cast<std::int64_t>(node.child)) < leaf_count);
      continue;
    }
    const auto left = static_cast<std::size_t>(node.child);
    DMC_CHECK(left + 1 < tree.nodes.size() && !reached[left] && !reached[left + 1]);
    reached[left] = reached[left + 1] = true;
    reached_count += 2;
    open.insert(open.end(), {left, left + 1});
  }
  DMC_CHECK(reached_count == tree.nodes.size());
  for (const LeafRow& row : tree.leaves) DMC_CHECK(row[kPartCount] == 0);
  for (std::size_t leaf = 0; leaf < leaf_count; ++leaf) DMC_CHECK(hasProbability(tree, leaf, facings));
}

}  // namespace

void checkForest(const Forest& forest) {
  DMC_CHECK(!forest.trees.empty());
  DMC_CHECK(forest.facings == 1 || forest.facings == kFacingCount);
  for (const ForestTree& tree : forest.trees) checkTree(tree, static_cast<std::size_t>(forest.facings));
}

int treeDepth(const ForestTree& tree) {
  std::vector<int> depth(tree.nodes.size(), 0);
  int deepest = 0;
  // Children stand behind their parents in every tree that was loaded or trained.
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    deepest = std::max(deepest, depth[i]);
    const std::int32_t child = tree.nodes[i].child;
    if (child <= 0) continue;
    DMC_CHECK(static_cast<std::size_t>(child) > i);
    depth[static_cast<std::size_t>(child)] = depth[static_cast<std::size_t>(child) + 1] = depth[i] + 1;
  }
  return deepest;
}

}  // namespace depthmocap
