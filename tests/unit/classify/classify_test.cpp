#include "libtracker/classify/classify.h"

#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "libtracker/classify/forest.h"
#include "libtracker/classify/label_image.h"
#include "tests/unit/classify/random_forest.h"

namespace depthmocap {
namespace {

constexpr double kFocal_px = 525.0;

void expectEqual(const ClassifiedPixels& a, const ClassifiedPixels& b) {
  ASSERT_EQ(a.pixels.size(), b.pixels.size());
  EXPECT_EQ(a.stride, b.stride);
  EXPECT_EQ(a.facing, b.facing);
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    ASSERT_EQ(a.pixels[i].x, b.pixels[i].x);
    ASSERT_EQ(a.pixels[i].y, b.pixels[i].y);
    ASSERT_EQ(a.pixels[i].depth_m, b.pixels[i].depth_m);
    ASSERT_EQ(a.pixels[i].probability, b.pixels[i].probability) << "pixel " << i;
  }
}

// Depth below `threshold` at the pixel's right goes left.
Forest oneSplitForest(std::int16_t u_x, float threshold_m) {
  ForestTree tree;
  tree.nodes = {ForestNode{{u_x, 0}, {0, 0}, threshold_m, 1}, ForestNode{{}, {}, 0, 0}, ForestNode{{}, {}, 0, -1}};
  tree.leaves.resize(2);
  tree.leaves[0][0] = 255;  // left: head
  tree.leaves[1][1] = 255;  // right: neck
  return Forest{{tree}, ""};
}

TEST(Classify, ProbeOutsideTheActorReadsBackground) {
  DepthImage depth(20, 3, 2.0F);  // the whole image is measured, but only columns 5 .. 9 are the actor
  MaskImage mask(20, 3, 0);
  for (int x = 5; x < 10; ++x) mask.at(x, 1) = 1;
  ClassifiedPixels result;
  classify(oneSplitForest(4, 1.0F), depth, mask, kFocal_px, {.stride = 1}, result);  // u / d = 2 px to the right
  ASSERT_EQ(result.pixels.size(), 5U);
  for (const auto& pixel : result.pixels) {
    const bool on_actor = pixel.x + 2 < 10;
    EXPECT_EQ(mostProbablePart(pixel), on_actor ? 0 : 1) << pixel.x;
    EXPECT_FLOAT_EQ(pixel.probability[on_actor ? 0 : 1], 1.0F);
  }
}

TEST(Classify, OffsetsScaleWithTheFocalLength) {
  DepthImage depth(20, 1, 2.0F);
  MaskImage mask(20, 1, 1);
  ClassifiedPixels result;
  classify(oneSplitForest(4, 1.0F), depth, mask, 2 * kFocal_px, {.stride = 1}, result);  // 4 px to the right
  for (const auto& pixel : result.pixels) EXPECT_EQ(mostProbablePart(pixel), pixel.x + 4 < 20 ? 0 : 1);
}

TEST(Classify, AveragesTheTrees) {
  Forest forest = oneSplitForest(0, 1.0F);
  forest.trees.push_back(forest.trees[0]);
  forest.trees[1].leaves[0] = {};
  forest.trees[1].leaves[0][4] = 85;
  ClassifiedPixels result;
  classify(forest, DepthImage(1, 1, 2.0F), MaskImage(1, 1, 1), kFocal_px, {.stride = 1}, result);
  ASSERT_EQ(result.pixels.size(), 1U);
  EXPECT_FLOAT_EQ(result.pixels[0].probability[0], 0.75F);
  EXPECT_FLOAT_EQ(result.pixels[0].probability[4], 0.25F);
}

TEST(Classify, EqualsTheReferenceExactly) {
  for (const int stride : {1, 2, 3}) {
    const Forest forest = test::randomForest(3, 3000, 7, stride == 1 ? 1 : kFacingCount);
    const test::Scene scene = test::standingFigure(161, 123, static_cast<std::uint64_t>(stride));
    ClassifiedPixels reference, simd, portable;
    classifyReference(forest, scene.depth, scene.mask, 140.0, {.stride = stride}, reference);
    ASSERT_GT(reference.pixels.size(), 100U);
    classify(forest, scene.depth, scene.mask, 140.0, {.stride = stride, .threads = 2}, simd);
    classify(forest, scene.depth, scene.mask, 140.0, {.stride = stride, .simd = false}, portable);
    expectEqual(reference, simd);
    expectEqual(reference, portable);
  }
}

TEST(Classify, EqualsTheReferenceAtExtremes) {
  Random random(5);
  Forest forest = test::randomForest(2, 200, 3, kFacingCount);
  for (ForestNode& node : forest.trees[0].nodes) {
    node.u = {INT16_MAX, INT16_MIN};
    node.v = {static_cast<std::int16_t>(random.next()), static_cast<std::int16_t>(random.next())};
  }
  DepthImage depth(64, 64, 0);
  MaskImage mask(64, 64, 1);
  for (float& d : depth.data) d = static_cast<float>(std::pow(10.0, random.uniform(-6, 2)));
  for (const double focal_px : {1.0, 525.0, 1e5}) {
    ClassifiedPixels reference, simd, portable;
    classifyReference(forest, depth, mask, focal_px, {.stride = 1}, reference);
    classify(forest, depth, mask, focal_px, {.stride = 1}, simd);
    classify(forest, depth, mask, focal_px, {.stride = 1, .simd = false}, portable);
    expectEqual(reference, simd);
    expectEqual(reference, portable);
  }
}

TEST(Classify, ProbabilitiesSumToOneAndMemoryIsReused) {
  const Forest forest = test::randomForest(3, 500, 11, kFacingCount);
  const test::Scene scene = test::standingFigure(320, 240, 1);
  ClassifiedPixels result;
  ClassifyMemory memory;
  classify(forest, scene.depth, scene.mask, 260.0, {}, memory, result);
  const auto* pixels = result.pixels.data();
  const auto* cut_out = memory.actor.depth_m.data();
  const auto* votes = memory.votes.data();
  classify(forest, scene.depth, scene.mask, 260.0, {}, memory, result);
  EXPECT_EQ(result.pixels.data(), pixels);
  EXPECT_EQ(memory.actor.depth_m.data(), cut_out);
  EXPECT_EQ(memory.votes.data(), votes);
  for (const auto& pixel : result.pixels) {
    EXPECT_NEAR(std::accumulate(pixel.probability.begin(), pixel.probability.end(), 0.0), 1.0, 1e-5);
  }
}

// One leaf in each half of the image: the left half knows the facing, the right half only what each facing would make
// it.
Forest facingForest() {
  ForestTree tree;
  tree.nodes = {ForestNode{{0, 0}, {0, 0}, 0.0F, 1}, ForestNode{{}, {}, 0, 0}, ForestNode{{}, {}, 0, -1}};
  tree.nodes[0] = {{20, 0}, {0, 0}, 1.0F, 1};  // right of the pixel is background: right leaf
  tree.leaves.resize(2 * kFacingCount);
  tree.leaves[0][0] = 40;                                                       // front: head
  tree.leaves[static_cast<std::size_t>(Facing::Back)][0] = 215;                 // back: head
  tree.leaves[kFacingCount][2] = 128;                                           // front: left shoulder
  tree.leaves[kFacingCount + static_cast<std::size_t>(Facing::Back)][3] = 127;  // back: right shoulder
  return Forest{{tree}, "", kFacingCount};
}

TEST(Classify, TheImageDecidesTheFacingAndTheFacingTheSide) {
  ClassifiedPixels result;
  classify(facingForest(), DepthImage(40, 10, 1.0F), MaskImage(40, 10, 1), kFocal_px, {.stride = 1}, result);
  EXPECT_GT(result.facing[static_cast<std::size_t>(Facing::Back)], 0.99F);
  int left = 0;
  for (const auto& pixel : result.pixels) {
    EXPECT_EQ(mostProbablePart(pixel), pixel.x < 20 ? 0 : 3);
    left += pixel.x < 20 ? 1 : 0;
  }
  EXPECT_EQ(left, 200);
}

TEST(Classify, WhatIsKnownOfTheFacingOverrulesTheImage) {
  ClassifiedPixels result;
  ClassifyConfig config{.stride = 1};
  config.facing_prior = {1, 0, 0, 0};
  classify(facingForest(), DepthImage(40, 10, 1.0F), MaskImage(40, 10, 1), kFocal_px, config, result);
  EXPECT_EQ(result.facing[0], 1.0F);
  EXPECT_GT(result.facing_by_image[static_cast<std::size_t>(Facing::Back)], 0.99F);
  for (const auto& pixel : result.pixels) EXPECT_EQ(mostProbablePart(pixel), pixel.x < 20 ? 0 : 2);
}

TEST(AssumeFacing, DecidesThePartsAgain) {
  ClassifiedPixels result;
  ClassifyMemory memory;
  classify(facingForest(), DepthImage(40, 10, 1.0F), MaskImage(40, 10, 1), kFocal_px, {.stride = 1}, memory, result);
  FacingShares front{};
  front[static_cast<std::size_t>(Facing::Front)] = 1.0F;
  assumeFacing(front, 2, memory, result);
  EXPECT_EQ(result.facing, front);
  for (const auto& pixel : result.pixels) EXPECT_EQ(mostProbablePart(pixel), pixel.x < 20 ? 0 : 2);
}

TEST(Classify, NobodyGivesNoPixels) {
  ClassifiedPixels result;
  classify(test::randomForest(1, 5, 1), DepthImage(32, 24, 1.0F), MaskImage(32, 24, 0), kFocal_px, {}, result);
  EXPECT_TRUE(result.pixels.empty());
  classify(test::randomForest(1, 5, 1), DepthImage(32, 24, 0.0F), MaskImage(32, 24, 1), kFocal_px, {}, result);
  EXPECT_TRUE(result.pixels.empty());
}

TEST(Classify, RefusesWhatOnlyABugPasses) {
  ClassifiedPixels result;
  const Forest forest = test::randomForest(1, 5, 1);
  EXPECT_THROW(classify(forest, DepthImage(4, 4), MaskImage(4, 5), kFocal_px, {}, result), std::logic_error);
  EXPECT_THROW(classify(forest, DepthImage(4, 4), MaskImage(4, 4), 0, {}, result), std::logic_error);
  EXPECT_THROW(classify(forest, DepthImage(4, 4), MaskImage(4, 4), kFocal_px, {.stride = 0}, result), std::logic_error);
  EXPECT_THROW(classify({}, DepthImage(4, 4), MaskImage(4, 4), kFocal_px, {}, result), std::logic_error);
}

}  // namespace
}  // namespace depthmocap
