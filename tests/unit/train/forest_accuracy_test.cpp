#include "forest/train/forest_accuracy.h"

#include <gtest/gtest.h>

namespace depthmocap {
namespace {

// One pixel of a left shoulder, seen from behind.
class OnePixel : public TrainingImageSource {
 public:
  [[nodiscard]] std::size_t count() const override { return 1; }
  [[nodiscard]] std::string description() const override { return "one pixel"; }
  void render(std::size_t, TrainingImage& image) override {
    image.depth.reset(3, 3, 0);
    image.labels.reset(3, 3, 0);
    image.depth.at(1, 1) = 2.0F;
    image.labels.at(1, 1) = static_cast<std::uint8_t>(Part::LeftShoulder);
    image.focal_px = 100;
    image.facing = Facing::Back;
  }
};

// Says: from the front, more likely, and then a right shoulder; or from behind, and then a left one.
Forest undecidedForest() {
  Forest forest;
  forest.facings = kFacingCount;
  forest.trees.resize(1);
  forest.trees[0].nodes.resize(1);
  forest.trees[0].leaves.resize(kFacingCount);
  forest.trees[0].leaves[0][static_cast<std::size_t>(partIndex(Part::RightShoulder))] = 150;
  forest.trees[0].leaves[2][static_cast<std::size_t>(partIndex(Part::LeftShoulder))] = 105;
  return forest;
}

TEST(ForestAccuracy, TellsTheSidesAndWhatKnowingTheSideWouldGive) {
  OnePixel source;
  const Forest forest = undecidedForest();
  const ForestAccuracy accuracy = measureAccuracy({&forest, 1}, source, 1, 1, [](double) {})[0];
  EXPECT_EQ(accuracy.all.total(), 1U);
  EXPECT_EQ(accuracy.all.accuracy(), 0.0);
  EXPECT_EQ(accuracy.facingAccuracy(), 0.0);
  EXPECT_EQ(accuracy.facing[2][0], 1U);
  EXPECT_EQ(accuracy.from[2].total(), 1U);
  EXPECT_EQ(accuracy.from[0].total(), 0U);
  EXPECT_EQ(accuracy.given_facing.accuracy(), 1.0);
}

}  // namespace
}  // namespace depthmocap
