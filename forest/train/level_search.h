#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "forest/train/communicator.h"
#include "forest/train/image_store.h"
#include "forest/train/split_search.h"
#include "forest/train/trained_tree.h"
#include "forest/train/training_samples.h"
#include "forest/train/tree_options.h"

namespace depthmocap {

// A node that may be split, and its samples on this rank (indices into TrainingSamples) in ascending order.
struct OpenNode {
  std::int32_t node = 0;
  std::uint32_t all = 0;  // samples on all ranks
  std::vector<std::uint32_t> samples;
};

// What was found for a node.
struct NodeSplit {
  std::int32_t node = 0;
  std::int64_t gain = -1;  // < 0: no split
  ForestNode split;        // without its child
};

// Finds the splits of one level of one tree. Nodes are taken in batches whose probes fit into memory; each batch's
// probes are read image by image. Every number depends on the seed, the level and the node alone.
//
// With several ranks, each reads the probes of its own samples. Of a large node every rank makes the histograms of its
// samples, and their sum is searched; a small node's probes, which are fewer bytes than its histograms, go to one rank.
class LevelSearch {
 public:
  LevelSearch(ImageStore& images, const TrainingSamples& samples, Communicator& ranks, const TreeOptions& options,
              int threads);

  // `seed` belongs to the tree, `level` is the depth of the nodes. Every rank has the same nodes, and gets all splits.
  std::vector<NodeSplit> search(const std::vector<OpenNode>& open, std::uint64_t seed, int level);

 private:
  struct Batch;
  struct Task;
  void addNode(const OpenNode& open, std::uint32_t before, Batch& batch) const;
  void readProbes(Batch& batch);
  void readImageProbes(const ImageCrop& crop, std::span<const std::uint32_t> rows, Batch& batch) const;
  void shareSmallNodes(Batch& batch) const;
  [[nodiscard]] std::vector<Task> tasksOf(const Batch& batch, int owner) const;
  void fillHistogram(const Batch& batch, const Task& task, SplitHistogram& histogram) const;
  void searchHistograms(const std::uint32_t* counts, Task& task) const;
  [[nodiscard]] std::vector<Task> searchOwnNodes(const Batch& batch) const;
  [[nodiscard]] std::vector<Task> searchLargeNodes(const Batch& batch) const;
  void tellAll(const Batch& batch, std::vector<Split>& best) const;
  void searchBatch(Batch& batch, std::vector<NodeSplit>& splits);
  [[nodiscard]] CandidateFeature featureOf(std::int32_t node, std::uint32_t feature) const;

  ImageStore& images_;
  const TrainingSamples& samples_;
  Communicator& ranks_;
  const TreeOptions& options_;
  int threads_;
  EntropyTable entropy_;
  std::uint64_t seed_ = 0;
  std::vector<ProbeOffset> offsets_;
};

}  // namespace depthmocap
