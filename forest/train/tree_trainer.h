#pragma once
#include <cstdint>
#include <functional>

#include "forest/train/communicator.h"
#include "forest/train/image_store.h"
#include "forest/train/trained_tree.h"
#include "forest/train/training_samples.h"
#include "forest/train/tree_options.h"

namespace depthmocap {

// Grows a tree level by level (Shotton 2011, section 3.3). `tree` is empty, or what an earlier call had reached: whole
// levels. After each level `finished_level(level)` is called with the tree grown so far, for checkpoints and progress.
// The same result, on every rank, for any number of ranks and threads and wherever it was interrupted.
void growTree(ImageStore& images, Communicator& ranks, const TreeOptions& options, std::uint64_t seed, int threads,
              TrainedTree& tree, const std::function<void(int level)>& finished_level);

}  // namespace depthmocap
