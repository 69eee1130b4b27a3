#include "libtracker/classify/forest_file.h"

#include <cmath>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>
#include <unistd.h>

#include "depthmocap/error.h"
#include "libtracker/classify/forest.h"
#include "tests/unit/classify/random_forest.h"

namespace depthmocap {
namespace {

class ForestFile : public ::testing::Test {
 protected:
  ForestFile() : path_(std::filesystem::path(::testing::TempDir()) / ("forest_" + std::to_string(getpid()))) {}
  ~ForestFile() override { std::filesystem::remove(path_); }

  [[nodiscard]] std::string bytes() const {
    std::ifstream in(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  void write(const std::string& content) const { std::ofstream(path_, std::ios::binary) << content; }

  std::filesystem::path path_;
};

TEST_F(ForestFile, RoundTripKeepsEverything) {
  Forest forest = test::randomForest(3, 400, 1, kFacingCount);
  forest.origin = "made by a test";
  saveForest(forest, path_);
  const Forest loaded = loadForest(path_);
  EXPECT_EQ(loaded.origin, forest.origin);
  EXPECT_EQ(loaded.facings, kFacingCount);
  ASSERT_EQ(loaded.trees.size(), 3U);
  for (std::size_t t = 0; t < 3; ++t) {
    const auto& a = forest.trees[t].nodes;
    const auto& b = loaded.trees[t].nodes;
    ASSERT_EQ(a.size(), b.size());
    EXPECT_EQ(forest.trees[t].leaves, loaded.trees[t].leaves);
    for (std::size_t i = 0; i < a.size(); ++i) {
      ASSERT_EQ(a[i].child, b[i].child);
      if (a[i].child <= 0) continue;
      ASSERT_EQ(a[i].u, b[i].u);
      ASSERT_EQ(a[i].v, b[i].v);
      ASSERT_EQ(a[i].threshold_m, b[i].threshold_m);
    }
  }
}

// Hours of training stand behind a forest: a long list of what it learnt from is no reason not to write it.
TEST_F(ForestFile, ALongOriginIsCut) {
  Forest forest = test::randomForest(1, 40, 1, 1);
  forest.origin = std::string(5000, 'x');
  saveForest(forest, path_);
  EXPECT_EQ(loadForest(path_).origin, std::string(4096, 'x'));
}

TEST_F(ForestFile, RenumbersAnyOrderOfNodes) {
  // Root 0 -> 3, 4; node 4 -> 1, 2.
  ForestTree tree;
  tree.nodes.resize(5);
  tree.nodes[0] = {{1, 2}, {3, 4}, 0.005F, 3};
  tree.nodes[4] = {{-5, 6}, {-7, 8}, -0.25F, 1};
  tree.nodes[3].child = -2;
  tree.nodes[1].child = -1;
  tree.nodes[2].child = 0;
  tree.leaves.resize(3);
  for (std::size_t i = 0; i < 3; ++i) tree.leaves[i][i] = 255;
  saveForest(Forest{{tree}, ""}, path_);
  const ForestTree loaded = loadForest(path_).trees[0];
  ASSERT_EQ(loaded.nodes.size(), 5U);
  EXPECT_EQ(loaded.nodes[0].child, 1);
  EXPECT_EQ(loaded.nodes[2].child, 3);
  EXPECT_EQ(loaded.nodes[2].threshold_m, -0.25F);
  EXPECT_EQ(loaded.leaves[static_cast<std::size_t>(-loaded.nodes[1].child)], tree.leaves[2]);
  EXPECT_EQ(loaded.leaves[static_cast<std::size_t>(-loaded.nodes[4].child)], tree.leaves[0]);
  EXPECT_EQ(treeDepth(loaded), 2);
}

TEST_F(ForestFile, OtherVersionsAreRefusedByName) {
  saveForest(test::randomForest(2, 50, 6), path_);
  std::string file = bytes();
  file[8] = 2;
  write(file);
  try {
    loadForest(path_);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("version 2"), std::string::npos);
  }
}

// Splits that share their probes, as those of a level do, cost two numbers each.
TEST_F(ForestFile, SharedProbesAreStoredOnce) {
  Forest own = test::randomForest(1, 2000, 7);
  Forest shared = own;
  for (ForestNode& node : shared.trees[0].nodes) {
    if (node.child > 0) node.u = {static_cast<std::int16_t>(node.u[0] & 7), 1}, node.v = {-1, node.u[0]};
  }
  saveForest(own, path_);
  const std::size_t size_own = bytes().size();
  saveForest(shared, path_);
  EXPECT_LT(bytes().size() + 2000 * 4, size_own);
  EXPECT_EQ(loadForest(path_).trees[0].leaves.size(), shared.trees[0].leaves.size());
}

TEST_F(ForestFile, SingleLeafIsAForest) {
  ForestTree tree;
  tree.nodes.resize(1);
  tree.leaves.resize(1);
  tree.leaves[0][3] = 255;
  saveForest(Forest{{tree}, ""}, path_);
  EXPECT_EQ(treeDepth(loadForest(path_).trees[0]), 0);
}

TEST_F(ForestFile, MissingOrForeignFileIsAnError) {
  EXPECT_THROW(loadForest(path_), Error);
  EXPECT_THROW(loadForest(::testing::TempDir()), Error);
  for (const char* content : {"", "DMCFORST", "just some text that is long enough to hold a header of a forest file"}) {
    write(content);
    EXPECT_THROW(loadForest(path_), Error) << content;
  }
}

TEST_F(ForestFile, EveryTruncationIsAnError) {
  saveForest(test::randomForest(2, 20, 2), path_);
  const std::string whole = bytes();
  for (std::size_t size = 0; size < whole.size(); size += 1 + size / 64) {
    write(whole.substr(0, size));
    EXPECT_THROW(loadForest(path_), Error) << size;
  }
  write(whole + "x");
  EXPECT_THROW(loadForest(path_), Error);
}

TEST_F(ForestFile, EveryFlippedByteIsAnError) {
  saveForest(test::randomForest(1, 20, 3), path_);
  const std::string whole = bytes();
  for (std::size_t i = 0; i < whole.size(); ++i) {
    std::string damaged = whole;
    damaged[i] = static_cast<char>(damaged[i] ^ 0x41);
    write(damaged);
    EXPECT_THROW(loadForest(path_), Error) << "byte " << i;
  }
}

// CRC-32 as in zlib, bit by bit.
std::uint32_t crc32Of(const std::string& text) {
  std::uint32_t crc = 0xFFFFFFFFU;
  for (const char c : text) {
    crc ^= static_cast<std::uint8_t>(c);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1U) ^ ((crc & 1U) != 0 ? 0xEDB88320U : 0U);
  }
  return ~crc;
}

// Damage behind a checksum that is right: the counts themselves must be distrusted.
TEST_F(ForestFile, ForgedCountsWithARightChecksumAreErrors) {
  constexpr std::size_t kHeader = 44;
  saveForest(test::randomForest(1, 20, 3), path_);
  const std::string whole = bytes();
  const std::size_t counts = kHeader + std::string("random").size();
  const auto forged = [&](std::size_t at, std::uint32_t value) {
    std::string file = whole;
    file.replace(at, 4, reinterpret_cast<const char*>(&value), 4);
    const std::uint32_t crc = crc32Of(file.substr(kHeader));
    file.replace(kHeader - 4, 4, reinterpret_cast<const char*>(&crc), 4);
    return file;
  };
  write(forged(counts, 41));
  EXPECT_NO_THROW(loadForest(path_));  // the forgery is good: 41 nodes is what the file holds
  for (const std::uint32_t value : {0U, 1U, 39U, 40U, 43U, 8388607U, 0x7FFFFFFFU, 0xFFFFFFFFU}) {
    write(forged(counts, value));
    EXPECT_THROW(loadForest(path_), Error) << "nodes " << value;
    write(forged(12, value == 1U ? 2U : value));
    EXPECT_THROW(loadForest(path_), Error) << "trees " << value;
    write(forged(16, value == 1U ? 4U : value));
    EXPECT_THROW(loadForest(path_), Error) << "facings " << value;
    write(forged(20, value));
    EXPECT_THROW(loadForest(path_), Error) << "origin " << value;
    write(forged(24, value));
    EXPECT_THROW(loadForest(path_), Error) << "packed " << value;
    write(forged(32, value));
    EXPECT_THROW(loadForest(path_), Error) << "unpacked " << value;
  }
}

TEST(CheckForest, RefusesCyclesOrphansAndBadIndices) {
  const Forest good = test::randomForest(1, 20, 4);
  EXPECT_NO_THROW(checkForest(good));
  const auto broken = [&](auto&& change) {
    Forest forest = good;
    change(forest.trees[0]);
    return forest;
  };
  EXPECT_THROW(checkForest({}), std::logic_error);
  EXPECT_THROW(checkForest(broken([](ForestTree& t) { t.nodes.clear(); })), std::logic_error);
  EXPECT_THROW(checkForest(broken([](ForestTree& t) { t.nodes.emplace_back(); })), std::logic_error);
  EXPECT_THROW(checkForest(broken([](ForestTree& t) { t.leaves.pop_back(); })), std::logic_error);
  EXPECT_THROW(checkForest(broken([](ForestTree& t) { t.leaves[0] = {}; })), std::logic_error);
  EXPECT_THROW(checkForest(broken([](ForestTree& t) { t.leaves[0][kPartCount] = 1; })), std::logic_error);
  Forest facings = good;
  facings.facings = 3;
  EXPECT_THROW(checkForest(facings), std::logic_error);
  EXPECT_THROW(checkForest(broken([](ForestTree& t) { t.nodes[0].child = 1 << 20; })), std::logic_error);
  EXPECT_THROW(checkForest(broken([](ForestTree& t) { t.nodes[1].child = 1; })), std::logic_error);
}

}  // namespace
}  // namespace depthmocap
