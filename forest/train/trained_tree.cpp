#include "forest/train/trained_tree.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "libtracker/core/check.h"

namespace depthmocap {
namespace {

using FacingCounts = TrainedTree::FacingCounts;
using FacingWeights = std::array<double, kFacingCount>;

// The samples of every node by facing: those of a leaf, or of both its children.
std::vector<FacingCounts> countsOfNodes(const TrainedTree& tree) {
  std::vector<FacingCounts> counts(tree.nodes.size());
  std::size_t leaf = tree.leaf_counts.size();
  for (std::size_t n = tree.nodes.size(); n-- > 0;) {
    const auto child = static_cast<std::size_t>(std::max(tree.nodes[n].split.child, 0));
    if (child == 0) {
      counts[n] = tree.leaf_counts[--leaf];
      continue;
    }
    for (std::size_t f = 0; f < kFacingCount; ++f) {
      for (std::size_t part = 0; part < kPartCount; ++part) {
        counts[n][f][part] = counts[child][f][part] + counts[child + 1][f][part];
      }
    }
  }
  DMC_CHECK(leaf == 0);
  return counts;
}

// Weights that make all facings of the training samples equally frequent.
FacingWeights equalisingWeights(const FacingCounts& all) {
  FacingWeights weights{};
  for (std::size_t f = 0; f < kFacingCount; ++f) {
    const double count = std::accumulate(all[f].begin(), all[f].end(), 0.0);
    weights[f] = count > 0 ? 1.0 / count : 0.0;
  }
  return weights;
}

// The rows of one leaf.
void addRows(const FacingCounts& counts, const FacingWeights& weights, std::size_t facings, int steps,
             std::vector<LeafRow>& rows) {
  std::array<std::array<double, kPartCount>, kFacingCount> shares{};
  double total = 0;
  for (std::size_t f = 0; f < kFacingCount; ++f) {
    const double weight = facings == 1 ? 1.0 : weights[f];
    for (std::size_t part = 0; part < kPartCount; ++part) {
      shares[facings == 1 ? 0 : f][part] += weight * counts[f][part];
      total += weight * counts[f][part];
    }
  }
  DMC_CHECK(total > 0);
  const auto level = [&](double share) {
    return static_cast<std::uint8_t>(std::lround(std::round(share * steps) * 255.0 / steps));
  };
  std::uint8_t* largest = nullptr;
  double largest_share = -1;
  const std::size_t first = rows.size();
  rows.resize(first + facings);
  for (std::size_t f = 0; f < facings; ++f) {
    for (std::size_t part = 0; part < kPartCount; ++part) {
      rows[first + f][part] = level(shares[f][part] / total);
      if (shares[f][part] <= largest_share) continue;
      largest_share = shares[f][part];
      largest = &rows[first + f][part];
    }
  }
  *largest = std::max(*largest, level(1.0 / steps));
}

}  // namespace

ForestTree finishedTree(const TrainedTree& tree, int max_depth, int facings, int probability_steps) {
  DMC_CHECK(probability_steps >= 1 && probability_steps <= 255);
  DMC_CHECK(facings == 1 || facings == kFacingCount);
  const std::vector<FacingCounts> counts = countsOfNodes(tree);
  const FacingWeights weights = equalisingWeights(counts.front());
  const auto rows = static_cast<std::size_t>(facings);
  ForestTree result;
  // Cutting at a depth keeps a prefix of a breadth-first order.
  for (std::size_t n = 0; n < tree.nodes.size() && tree.nodes[n].depth <= max_depth; ++n) {
    const TrainedTree::Node& node = tree.nodes[n];
    ForestNode& kept = result.nodes.emplace_back(node.split);
    if (node.split.child > 0 && node.depth < max_depth) continue;
    kept = {};
    kept.child = -static_cast<std::int32_t>(result.leaves.size() / rows);
    addRows(counts[n], weights, rows, probability_steps, result.leaves);
  }
  return result;
}

}  // namespace depthmocap
