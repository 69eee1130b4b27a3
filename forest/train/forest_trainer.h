#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "forest/train/communicator.h"
#include "forest/train/trained_tree.h"
#include "forest/train/training_image.h"
#include "forest/train/tree_options.h"
#include "libtracker/classify/forest.h"

namespace depthmocap {

struct ForestTrainingOptions {
  TreeOptions tree;
  int trees = 3;           // (1 .. 64)
  std::uint64_t seed = 1;  // of pixels, mirroring and features
  int threads = 1;         // (>= 1)
  std::size_t memory_bytes =
      8'000'000'000ULL;              // [byte] of images kept in memory; the others are rendered again and again
  std::filesystem::path checkpoint;  // a file, written after every level; empty = none
  bool resume = false;               // go on from the checkpoint where there is one
  void validate() const;             // throws Error naming field, value and rule
};

// What is being done ("rendering", "tree 1 of 3") and how much of all work is done, in [0, 1]. Called from any thread.
using TrainingProgress = std::function<void(const std::string& stage, double done)>;

// Trains the trees one after the other, on every rank the same ones. Each rank has its share of the images; the first
// writes the checkpoint. The same trees for any number of ranks and threads, and whether interrupted or not.
// The checkpoint is read by all ranks. Throws Error for options, the source's failures, and a checkpoint that cannot be
// written or belongs to another training.
std::vector<TrainedTree> trainForest(TrainingImageSource& source, Communicator& ranks,
                                     const ForestTrainingOptions& options, const TrainingProgress& progress);

// How a trained forest is made into one to use.
struct FinishOptions {
  std::size_t trees = 64;      // (>= 1) at most so many of the trees
  int depth = 64;              // (>= 0) cut off there
  int facings = kFacingCount;  // 1: leaves do not tell the facings apart
  int probability_steps = 63;  // (1 .. 255) that probabilities are rounded to
};
Forest finishedForest(const std::vector<TrainedTree>& trained, const FinishOptions& options, const std::string& origin);

}  // namespace depthmocap
