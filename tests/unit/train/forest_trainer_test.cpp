#include "forest/train/forest_trainer.h"

#include <fstream>
#include <stdexcept>

#include <gtest/gtest.h>
#include <unistd.h>

#include "depthmocap/error.h"
#include "forest/train/forest_accuracy.h"
#include "tests/unit/train/disc_figures.h"
#include "tests/unit/train/thread_ranks.h"

namespace depthmocap {
namespace {

ForestTrainingOptions smallOptions() {
  ForestTrainingOptions options;
  options.trees = 2;
  options.tree.depth = 9;
  options.tree.pixels_per_image = 60;
  options.tree.candidates = 80;
  options.tree.features.offsets = 64;
  options.tree.node_samples = 1000;
  options.tree.batch_samples = 3000;
  return options;
}

const TrainingProgress kSilent = [](const std::string&, double) {};

std::vector<TrainedTree> train(const ForestTrainingOptions& options, std::size_t images = 60) {
  test::DiscFigures source(images, 1);
  SingleCommunicator alone;
  return trainForest(source, alone, options, kSilent);
}

void expectEqual(const std::vector<TrainedTree>& a, const std::vector<TrainedTree>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t t = 0; t < a.size(); ++t) {
    ASSERT_EQ(a[t].nodes.size(), b[t].nodes.size());
    for (std::size_t n = 0; n < a[t].nodes.size(); ++n) {
      const auto& x = a[t].nodes[n];
      const auto& y = b[t].nodes[n];
      ASSERT_EQ(x.counts, y.counts) << "tree " << t << " node " << n;
      ASSERT_EQ(x.split.child, y.split.child);
      ASSERT_EQ(x.split.u, y.split.u);
      ASSERT_EQ(x.split.v, y.split.v);
      ASSERT_EQ(x.split.threshold_m, y.split.threshold_m);
    }
    ASSERT_EQ(a[t].leaf_counts, b[t].leaf_counts);
  }
}

TEST(ForestTrainer, LearnsFiguresItHasNotSeen) {
  const Forest forest = finishedForest(train(smallOptions(), 400), {}, "test");
  EXPECT_NO_THROW(checkForest(forest));
  test::DiscFigures unseen(20, 999);
  const ConfusionMatrix confusion = measureAccuracy({&forest, 1}, unseen, 2, 2, [](double) {})[0].all;
  EXPECT_GT(confusion.total(), 1000U);
  // Mirroring makes front and back views of these figures equally likely: left and right are a toss of a coin here, but
  // every other confusion would be the trainer's fault.
  double right = 0;
  for (int part = 0; part < kPartCount; ++part) {
    const auto row = static_cast<std::size_t>(part);
    const auto mirror = static_cast<std::size_t>(partIndex(mirrored(partAt(part))));
    right += static_cast<double>(confusion.count[row][row] + (mirror == row ? 0 : confusion.count[row][mirror]));
  }
  EXPECT_GT(right / static_cast<double>(confusion.total()), 0.9);
}

TEST(ForestTrainer, SameTreesForAnyNumberOfThreadsAndAnyMemory) {
  ForestTrainingOptions options = smallOptions();
  const auto one = train(options);
  options.threads = 3;
  expectEqual(one, train(options));
  options.memory_bytes = 40000;  // a few images
  expectEqual(one, train(options));
}

// Large nodes are searched by sums of histograms, small ones by one rank each: both ways occur here, and nodes of which
// only a selection is looked at.
TEST(ForestTrainer, SameTreesForAnyNumberOfRanks) {
  ForestTrainingOptions options = smallOptions();
  options.tree.depth = 6;
  options.tree.node_samples = 20000;
  options.tree.batch_samples = 30000;
  const auto alone = train(options, 400);
  for (const int ranks : {2, 3}) {
    std::vector<std::vector<TrainedTree>> trees(static_cast<std::size_t>(ranks));
    test::ThreadRanks(ranks).run([&](Communicator& communicator) {
      test::DiscFigures source(400, 1);
      trees[static_cast<std::size_t>(communicator.rank())] = trainForest(source, communicator, options, kSilent);
    });
    for (const auto& of_rank : trees) expectEqual(alone, of_rank);
  }
}

TEST(ForestTrainer, CountsOfChildrenAddUpAndSidesHaveTheirMinimum) {
  ForestTrainingOptions options = smallOptions();
  options.tree.node_samples = 1 << 20;
  options.tree.batch_samples = 1 << 20;
  options.tree.min_leaf = 12;
  for (const TrainedTree& tree : train(options)) {
    ASSERT_GT(tree.nodes.size(), 20U);
    for (const auto& node : tree.nodes) {
      std::uint32_t all = 0;
      for (std::size_t part = 0; part < kPartCount; ++part) {
        all += node.counts[part];
        if (node.split.child <= 0) continue;
        const auto child = static_cast<std::size_t>(node.split.child);
        ASSERT_EQ(node.counts[part], tree.nodes[child].counts[part] + tree.nodes[child + 1].counts[part]);
      }
      ASSERT_GE(all, 12U);
    }
  }
}

TEST(ForestTrainer, RespectsDepthAndNodeLimits) {
  ForestTrainingOptions options = smallOptions();
  options.tree.depth = 4;
  for (const ForestTree& tree : finishedForest(train(options), {}, "").trees) EXPECT_EQ(treeDepth(tree), 4);
  options.tree.depth = 12;
  options.tree.max_nodes = 21;
  for (const TrainedTree& tree : train(options)) EXPECT_EQ(tree.nodes.size(), 21U);
}

TEST(ForestTrainer, CutForestIsShallower) {
  const auto trained = train(smallOptions());
  const Forest cut = finishedForest(trained, {.trees = 1, .depth = 3}, "");
  ASSERT_EQ(cut.trees.size(), 1U);
  EXPECT_EQ(treeDepth(cut.trees[0]), 3);
  EXPECT_NO_THROW(checkForest(cut));
}

TEST(ForestTrainer, LeavesHoldWhatFellIntoThemByFacing) {
  ForestTrainingOptions options = smallOptions();
  options.tree.depth = 5;
  for (const TrainedTree& tree : train(options)) {
    std::size_t leaf = 0;
    std::array<std::uint64_t, kFacingCount> seen{};
    for (const auto& node : tree.nodes) {
      if (node.split.child > 0) continue;
      PartCounts sum{};
      for (std::size_t f = 0; f < kFacingCount; ++f) {
        for (std::size_t part = 0; part < kPartCount; ++part) {
          sum[part] += tree.leaf_counts[leaf][f][part];
          seen[f] += tree.leaf_counts[leaf][f][part];
        }
      }
      ASSERT_EQ(sum, node.counts);
      ++leaf;
    }
    EXPECT_EQ(leaf, tree.leaf_counts.size());
    for (const auto n : seen) EXPECT_GT(n, 0U);
  }
}

// Two facings, the second seen three times as often: as if they were equally frequent.
TEST(FinishedTree, FacingsAreMadeEquallyFrequent) {
  TrainedTree tree;
  tree.nodes.resize(1);
  tree.leaf_counts.resize(1);
  tree.leaf_counts[0][0][3] = 100;
  tree.leaf_counts[0][2][5] = 300;
  const ForestTree finished = finishedTree(tree, 9, kFacingCount, 255);
  ASSERT_EQ(finished.leaves.size(), 4U);
  EXPECT_NEAR(finished.leaves[0][3], 127.5, 1);
  EXPECT_NEAR(finished.leaves[2][5], 127.5, 1);
  const ForestTree plain = finishedTree(tree, 9, 1, 255);
  ASSERT_EQ(plain.leaves.size(), 1U);
  EXPECT_NEAR(plain.leaves[0][3], 64, 1);
  EXPECT_NEAR(plain.leaves[0][5], 191, 1);
}

class ForestCheckpoint : public ::testing::Test {
 protected:
  ~ForestCheckpoint() override { std::filesystem::remove(path_); }
  std::filesystem::path path_ = std::filesystem::path(::testing::TempDir()) / ("ckpt_" + std::to_string(getpid()));
};

TEST_F(ForestCheckpoint, ResumedTrainingGivesTheSameTrees) {
  ForestTrainingOptions options = smallOptions();
  const auto whole = train(options);
  options.checkpoint = path_;
  int calls = 0;
  test::DiscFigures source(60, 1);
  const auto interrupt = [&](const std::string& stage, double) {
    if (stage == "tree 2 of 2" && ++calls == 4) throw std::runtime_error("interrupted");
  };
  SingleCommunicator alone;
  EXPECT_THROW(trainForest(source, alone, options, interrupt), std::runtime_error);
  options.resume = true;
  expectEqual(whole, train(options));
  options.seed = 2;
  EXPECT_THROW(train(options), Error);  // another training's checkpoint
}

// The first of two ranks; the other one has three nodes already.
class RankBesideOneThatIsAhead : public SingleCommunicator {
 public:
  [[nodiscard]] int size() const override { return 2; }
  void sum(std::span<std::int64_t> numbers) override { numbers[0] += 3; }
};

TEST_F(ForestCheckpoint, RanksThatStartAtDifferentPlacesAreAnError) {
  test::DiscFigures source(5, 1);
  RankBesideOneThatIsAhead rank;
  EXPECT_THROW(trainForest(source, rank, smallOptions(), kSilent), Error);
}

TEST_F(ForestCheckpoint, DamagedCheckpointIsAnError) {
  ForestTrainingOptions options = smallOptions();
  options.checkpoint = path_;
  train(options, 5);
  std::filesystem::resize_file(path_, std::filesystem::file_size(path_) - 1);
  options.resume = true;
  EXPECT_THROW(train(options, 5), Error);
  std::ofstream(path_) << "not a checkpoint at all";
  EXPECT_THROW(train(options, 5), Error);
}

TEST(ForestTrainer, BadOptionsAreErrors) {
  const auto refused = [](auto&& change) {
    ForestTrainingOptions options = smallOptions();
    change(options);
    EXPECT_THROW(options.validate(), Error);
  };
  refused([](auto& o) { o.trees = 0; });
  refused([](auto& o) { o.threads = 0; });
  refused([](auto& o) { o.tree.depth = 0; });
  refused([](auto& o) { o.tree.min_leaf = 0; });
  refused([](auto& o) { o.tree.facing_weight = -1; });
  refused([](auto& o) { o.tree.features.offsets = 1; });
  refused([](auto& o) { o.tree.features.max_offset = 1; });
  refused([](auto& o) { o.tree.batch_samples = 10; });
  refused([](auto& o) { o.resume = true; });
  EXPECT_THROW(train(smallOptions(), 0), Error);
}

}  // namespace
}  // namespace depthmocap
