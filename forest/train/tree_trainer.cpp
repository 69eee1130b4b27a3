#include "forest/train/tree_trainer.h"

#include <algorithm>
#include <numeric>

#include "forest/train/crop_probe.h"
#include "forest/train/level_search.h"
#include "libtracker/core/parallel.h"

namespace depthmocap {
namespace {

class TreeGrower {
 public:
  TreeGrower(ImageStore& images, Communicator& ranks, const TreeOptions& options, std::uint64_t seed, int threads,
             TrainedTree& tree)
      : images_(images),
        ranks_(ranks),
        options_(options),
        seed_(seed),
        threads_(threads),
        tree_(tree),
        samples_(drawSamples(images, options.pixels_per_image, seed, threads)),
        search_(images, samples_, ranks, options, threads),
        node_of_(samples_.size(), 0) {}

  void grow(const std::function<void(int)>& finished_level) {
    if (tree_.nodes.empty()) {
      tree_.nodes.resize(1);
      countSamples(0);
    }
    for (int level = 0; level < options_.depth; ++level) {
      if (!growLevel(level)) break;
      finished_level(level);
    }
    countLeaves();
  }

 private:
  // One more level, or the way down an existing one; false where nothing was split.
  bool growLevel(int level) {
    const auto [first, end] = nodesOfLevel(level);
    if (first == end) return false;
    const bool is_new = end == tree_.nodes.size();
    if (is_new && !splitNodes(first, end, level)) return false;
    descend(first, end);
    if (is_new) countSamples(end);
    return true;
  }

  std::pair<std::size_t, std::size_t> nodesOfLevel(int level) const {
    const auto& nodes = tree_.nodes;
    const auto first = std::find_if(nodes.begin(), nodes.end(), [&](const auto& n) { return n.depth >= level; });
    const auto end = std::find_if(first, nodes.end(), [&](const auto& n) { return n.depth > level; });
    return {static_cast<std::size_t>(first - nodes.begin()), static_cast<std::size_t>(end - nodes.begin())};
  }

  bool isOpen(const PartCounts& counts) const {
    const std::uint32_t all = std::accumulate(counts.begin(), counts.end(), 0U);
    return all >= 2 * options_.min_leaf && *std::max_element(counts.begin(), counts.end()) < all;
  }

  std::vector<OpenNode> collectOpenNodes(std::size_t first, std::size_t end) const {
    std::vector<OpenNode> open;
    std::vector<std::int32_t> place(end - first, -1);
    for (std::size_t n = first; n < end; ++n) {
      const PartCounts& counts = tree_.nodes[n].counts;
      if (!isOpen(counts)) continue;
      place[n - first] = static_cast<std::int32_t>(open.size());
      auto& node = open.emplace_back();
      node.node = static_cast<std::int32_t>(n);
      node.all = std::accumulate(counts.begin(), counts.end(), 0U);
    }
    for (std::size_t s = 0; s < node_of_.size(); ++s) {
      const auto n = static_cast<std::size_t>(node_of_[s]);
      if (n < first || place[n - first] < 0) continue;
      open[static_cast<std::size_t>(place[n - first])].samples.push_back(static_cast<std::uint32_t>(s));
    }
    return open;
  }

  bool splitNodes(std::size_t first, std::size_t end, int level) {
    std::vector<NodeSplit> splits = search_.search(collectOpenNodes(first, end), seed_, level);
    std::erase_if(splits, [](const NodeSplit& split) { return split.gain <= 0; });
    keepBest(splits);
    for (const NodeSplit& found : splits) {
      auto& node = tree_.nodes[static_cast<std::size_t>(found.node)];
      node.split = found.split;
      node.split.child = static_cast<std::int32_t>(tree_.nodes.size());
      TrainedTree::Node child;
      child.depth = level + 1;
      tree_.nodes.insert(tree_.nodes.end(), 2, child);
    }
    return !splits.empty();
  }

  // As many splits as max_nodes leaves room for, those that gain most, in the order of their nodes.
  void keepBest(std::vector<NodeSplit>& splits) const {
    const std::size_t room = (options_.max_nodes - std::min(options_.max_nodes, tree_.nodes.size())) / 2;
    if (splits.size() <= room) return;
    std::stable_sort(splits.begin(), splits.end(), [](const auto& a, const auto& b) { return a.gain > b.gain; });
    splits.resize(room);
    std::sort(splits.begin(), splits.end(), [](const auto& a, const auto& b) { return a.node < b.node; });
  }

  // Moves every sample that is in one of the nodes to the node's child.
  void descend(std::size_t first, std::size_t end) {
    parallelFor(threads_, images_.count(), [&](std::size_t image) {
      ImageCrop scratch;
      const ImageCrop* crop = nullptr;
      for (std::uint32_t s = samples_.first[image]; s < samples_.first[image + 1]; ++s) {
        const auto n = static_cast<std::size_t>(node_of_[s]);
        if (n < first || n >= end || tree_.nodes[n].split.child <= 0) continue;
        if (crop == nullptr) crop = &images_.get(image, scratch);
        const auto& sample = samples_.samples[s];
        node_of_[s] = tree_.nodes[n].split.child + (goesRight(*crop, sample.x, sample.y, tree_.nodes[n].split) ? 1 : 0);
      }
    });
  }

  // The samples of all ranks in the nodes from `first` on.
  void countSamples(std::size_t first) {
    std::vector<std::uint32_t> counts((tree_.nodes.size() - first) * kPartCount, 0);
    for (std::size_t s = 0; s < node_of_.size(); ++s) {
      const auto n = static_cast<std::size_t>(node_of_[s]);
      if (n >= first) ++counts[(n - first) * kPartCount + samples_.samples[s].part_index];
    }
    ranks_.sum(counts);
    for (std::size_t n = first; n < tree_.nodes.size(); ++n) {
      std::copy_n(counts.begin() + static_cast<std::ptrdiff_t>((n - first) * kPartCount), kPartCount,
                  tree_.nodes[n].counts.begin());
    }
  }

  void countLeaves() {
    std::vector<std::int32_t> leaf_of(tree_.nodes.size(), -1);
    std::int32_t leaves = 0;
    for (std::size_t n = 0; n < tree_.nodes.size(); ++n) {
      if (tree_.nodes[n].split.child <= 0) leaf_of[n] = leaves++;
    }
    std::vector<std::uint32_t> counts(static_cast<std::size_t>(leaves) * kFacingCount * kPartCount, 0);
    for (std::size_t s = 0; s < node_of_.size(); ++s) {
      const auto leaf = static_cast<std::size_t>(leaf_of[static_cast<std::size_t>(node_of_[s])]);
      const auto facing = static_cast<std::size_t>(samples_.facing[samples_.image[s]]);
      ++counts[(leaf * kFacingCount + facing) * kPartCount + samples_.samples[s].part_index];
    }
    ranks_.sum(counts);
    tree_.leaf_counts.assign(static_cast<std::size_t>(leaves), {});
    for (std::size_t i = 0; i < counts.size(); ++i) {
      const std::size_t row = i / kPartCount;
      tree_.leaf_counts[row / kFacingCount][row % kFacingCount][i % kPartCount] = counts[i];
    }
  }

  ImageStore& images_;
  Communicator& ranks_;
  const TreeOptions& options_;
  std::uint64_t seed_;
  int threads_;
  TrainedTree& tree_;
  TrainingSamples samples_;
  LevelSearch search_;
  std::vector<std::int32_t> node_of_;  // where each sample is
};

}  // namespace

void growTree(ImageStore& images, Communicator& ranks, const TreeOptions& options, std::uint64_t seed, int threads,
              TrainedTree& tree, const std::function<void(int)>& finished_level) {
  options.validate();
  TreeGrower(images, ranks, options, seed, threads, tree).grow(finished_level);
}

}  // namespace depthmocap
