#pragma once
#include <cstdint>
#include <vector>

#include "forest/train/image_store.h"
#include "forest/train/split_search.h"
#include "forest/train/trained_tree.h"
#include "forest/train/training_samples.h"
#include "forest/train/tree_options.h"

namespace depthmocap {

// A node that may be split, and its samples (indices into TrainingSamples) in ascending order.
struct OpenNode {
  std::int32_t node = 0;
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
class LevelSearch {
 public:
  LevelSearch(ImageStore& images, const TrainingSamples& samples, const TreeOptions& options, int threads);

  // `seed` belongs to the tree, `level` is the depth of the nodes. `counts[i]` are all samples of open[i].
  std::vector<NodeSplit> search(const std::vector<OpenNode>& open, std::uint64_t seed, int level);

 private:
  struct Batch;
  struct Task;
  void readProbes(Batch& batch);
  void readImageProbes(const ImageCrop& crop, const Batch& batch, std::size_t begin, std::size_t end);
  Split searchTask(const Batch& batch, const Task& task, std::uint64_t seed);
  void searchBatch(Batch& batch, std::uint64_t seed, std::vector<NodeSplit>& splits);

  ImageStore& images_;
  const TrainingSamples& samples_;
  const TreeOptions& options_;
  int threads_;
  EntropyTable entropy_;
  std::vector<ProbeOffset> offsets_;
  std::vector<std::uint16_t> probes_mm_;  // [row of the batch][offset]
};

}  // namespace depthmocap
