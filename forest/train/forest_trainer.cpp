#include "forest/train/forest_trainer.h"

#include <algorithm>
#include <span>

#include <fmt/format.h>

#include "depthmocap/error.h"
#include "forest/train/image_store.h"
#include "forest/train/training_checkpoint.h"
#include "forest/train/tree_trainer.h"
#include "libtracker/core/check.h"
#include "libtracker/core/config_fields.h"

namespace depthmocap {
namespace {

constexpr double kRenderShare = 0.3;  // of all work, roughly
constexpr std::uint64_t kTreeSeedStep = 0x9E3779B97F4A7C15ULL;

// Everything that the trees depend on.
std::string fingerprint(const TrainingImageSource& source, const ForestTrainingOptions& o) {
  const FeatureOptions& f = o.tree.features;
  return fmt::format(
      "{}; {} images, {} pixels, depth {}, {} offsets of {} .. {}, {} at the center, {} candidates, leaves >= {}, "
      "nodes <= {}, facing weight {}, "
      "{} samples a node, {} a batch, {} trees, seed {}",
      source.description(), source.count(), o.tree.pixels_per_image, o.tree.depth, f.offsets, f.min_offset,
      f.max_offset, f.center_share, o.tree.candidates, o.tree.min_leaf, o.tree.max_nodes, o.tree.facing_weight,
      o.tree.node_samples, o.tree.batch_samples, o.trees, o.seed);
}

// Ranks at different places would wait for each other for ever.
void checkSameStart(const std::vector<TrainedTree>& trees, Communicator& ranks) {
  std::int64_t nodes = 0;
  for (const TrainedTree& tree : trees) nodes += static_cast<std::int64_t>(tree.nodes.size());
  std::int64_t of_all = nodes;
  ranks.sum(std::span(&of_all, 1));
  if (of_all == nodes * ranks.size()) return;
  throw Error("not every rank reads the same checkpoint", "resume", "keep it in a folder that all machines share");
}

}  // namespace

void ForestTrainingOptions::validate() const {
  tree.validate();
  checkConfig(trees >= 1 && trees <= 64, "ForestTrainingOptions", "trees", trees, "from 1 to 64");
  checkConfig(threads >= 1, "ForestTrainingOptions", "threads", threads, "at least 1");
  if (resume && checkpoint.empty()) throw Error("nothing to resume from", "resume", "name the checkpoint");
}

std::vector<TrainedTree> trainForest(TrainingImageSource& source, Communicator& ranks,
                                     const ForestTrainingOptions& options, const TrainingProgress& progress) {
  options.validate();
  if (source.count() == 0) throw Error("no training images", source.description(), "ask for at least one image");
  const std::string identity = fingerprint(source, options);
  std::vector<TrainedTree> trees;
  if (options.resume) trees = loadCheckpoint(options.checkpoint, identity);
  trees.resize(static_cast<std::size_t>(options.trees));
  checkSameStart(trees, ranks);

  ImageStore images(source, {ranks.rank(), ranks.size()}, options.seed, options.memory_bytes, options.threads,
                    [&](double done) { progress("rendering", kRenderShare * done); });
  for (std::size_t t = 0; t < trees.size(); ++t) {
    const std::string stage = fmt::format("tree {} of {}", t + 1, trees.size());
    const auto finished_level = [&](int level) {
      if (!options.checkpoint.empty() && ranks.rank() == 0) saveCheckpoint(options.checkpoint, identity, trees);
      const double share = (static_cast<double>(t) + (level + 1.0) / options.tree.depth) / options.trees;
      progress(stage, kRenderShare + (1 - kRenderShare) * share);
    };
    growTree(images, ranks, options.tree, options.seed + (t + 1) * kTreeSeedStep, options.threads, trees[t],
             finished_level);
  }
  return trees;
}

Forest finishedForest(const std::vector<TrainedTree>& trained, const FinishOptions& options,
                      const std::string& origin) {
  DMC_CHECK(options.trees >= 1 && !trained.empty());
  Forest forest;
  forest.origin = origin;
  forest.facings = options.facings;
  for (std::size_t t = 0; t < std::min(options.trees, trained.size()); ++t) {
    forest.trees.push_back(finishedTree(trained[t], options.depth, options.facings, options.probability_steps));
  }
  return forest;
}

}  // namespace depthmocap
