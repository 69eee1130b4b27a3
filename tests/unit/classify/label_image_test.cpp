#include "libtracker/classify/label_image.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "libtracker/classify/classify.h"
#include "tests/unit/classify/random_forest.h"

namespace depthmocap {
namespace {

TEST(LabelImage, EveryMaskPixelTakesANearestClassifiedPixel) {
  const test::Scene scene = test::standingFigure(97, 61, 9);
  ClassifiedPixels classified;
  classify(test::randomForest(1, 300, 5), scene.depth, scene.mask, 140.0, {.stride = 3}, classified);
  PartImage labels;
  labelImage(classified, scene.mask, labels);
  ASSERT_EQ(labels.width, 97);
  for (int y = 0; y < labels.height; ++y) {
    for (int x = 0; x < labels.width; ++x) {
      if (scene.mask.at(x, y) == 0) {
        ASSERT_EQ(labels.at(x, y), 0);
        continue;
      }
      int nearest = std::numeric_limits<int>::max();
      for (const auto& p : classified.pixels) {
        nearest = std::min(nearest, (p.x - x) * (p.x - x) + (p.y - y) * (p.y - y));
      }
      bool matches = false;
      for (const auto& p : classified.pixels) {
        const bool at_nearest = (p.x - x) * (p.x - x) + (p.y - y) * (p.y - y) == nearest;
        matches = matches || (at_nearest && labels.at(x, y) == mostProbablePart(p) + 1);
      }
      ASSERT_TRUE(matches) << x << " " << y;
    }
  }
}

TEST(LabelImage, NothingClassifiedLeavesNoLabel) {
  PartImage labels;
  labelImage({}, MaskImage(8, 6, 1), labels);
  EXPECT_EQ(labels.data, PartImage(8, 6, 0).data);
}

}  // namespace
}  // namespace depthmocap
