#include "forest/train/trained_tree.h"

#include <algorithm>
#include <cmath>

#include "libtracker/core/check.h"

namespace depthmocap {
namespace {

std::array<std::uint8_t, kPartCount> leafOf(const PartCounts& counts, int steps) {
  double total = 0;
  for (const std::uint32_t n : counts) total += n;
  DMC_CHECK(total > 0);
  std::array<std::uint8_t, kPartCount> leaf{};
  const auto level = [&](double share) {
    return static_cast<std::uint8_t>(std::lround(std::round(share * steps) * 255.0 / steps));
  };
  for (std::size_t part = 0; part < kPartCount; ++part) leaf[part] = level(counts[part] / total);
  const auto top = static_cast<std::size_t>(std::max_element(counts.begin(), counts.end()) - counts.begin());
  leaf[top] = std::max(leaf[top], level(1.0 / steps));
  return leaf;
}

}  // namespace

ForestTree finishedTree(const TrainedTree& tree, int max_depth, int probability_steps) {
  DMC_CHECK(probability_steps >= 1 && probability_steps <= 255);
  ForestTree result;
  // Cutting at a depth keeps a prefix of a breadth-first order.
  for (const TrainedTree::Node& node : tree.nodes) {
    if (node.depth > max_depth) break;
    ForestNode& kept = result.nodes.emplace_back(node.split);
    if (node.split.child > 0 && node.depth < max_depth) continue;
    kept = {};
    kept.child = -static_cast<std::int32_t>(result.leaves.size());
    result.leaves.push_back(leafOf(node.counts, probability_steps));
  }
  return result;
}

}  // namespace depthmocap
