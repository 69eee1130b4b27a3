#include "libtracker/classify/forest_classifier.h"

#include <gtest/gtest.h>

#include "tests/support/known_labels.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/classify/random_forest.h"

namespace depthmocap {
namespace {

CameraModel camera(const test::Scene& scene) {
  CameraModel model;
  model.width = scene.depth.width;
  model.height = scene.depth.height;
  return model;
}

TEST(ForestClassifier, SaysWhatTheForestSays) {
  const test::Scene scene = test::standingFigure(160, 120, 3);
  const Forest forest = test::randomForest(2, 8, 4);
  const ForestClassifier classifier(forest);
  const auto memory = classifier.newMemory();
  ClassifiedPixels by_class, by_function;
  classifier.classify(scene.depth, scene.mask, camera(scene), {}, *memory, by_class);
  classify(forest, scene.depth, scene.mask, camera(scene).fx, {}, by_function);
  ASSERT_FALSE(by_class.pixels.empty());
  ASSERT_EQ(by_class.pixels.size(), by_function.pixels.size());
  for (std::size_t i = 0; i < by_class.pixels.size(); ++i) {
    EXPECT_EQ(by_class.pixels[i].probability, by_function.pixels[i].probability);
  }
}

TEST(ForestClassifier, AnEmptyForestIsTheCallersError) {
  const std::string error = errorOf([] { ForestClassifier empty{Forest{}}; });
  EXPECT_NE(error.find("has no tree"), std::string::npos) << error;
  EXPECT_NE(error.find("Models::shipped()"), std::string::npos) << error;
}

TEST(KnownLabels, HoldForEveryFacing) {
  test::Scene scene;
  scene.depth = DepthImage(40, 10, 1.0F);
  scene.mask = MaskImage(40, 10, 1);
  KnownLabels classifier(std::make_shared<const ForestClassifier>(test::randomForest(1, 5, 1)));
  PartImage parts(40, 10, 7);
  parts.at(3, 5) = 0;
  classifier.setLabels(parts);
  const auto memory = classifier.newMemory();
  ClassifiedPixels result;
  classifier.classify(scene.depth, scene.mask, camera(scene), {.stride = 1}, *memory, result);
  FacingShares front{};
  front[static_cast<std::size_t>(Facing::Front)] = 1.0F;
  if (classifier.tellsFacings()) classifier.assumeFacing(front, 2, *memory, result);
  ASSERT_EQ(result.pixels.size(), 400U);
  for (const auto& pixel : result.pixels) {
    const bool unknown = pixel.x == 3 && pixel.y == 5;
    EXPECT_FLOAT_EQ(pixel.probability[6], unknown ? 1.0F / kPartCount : 1.0F);
  }
}

}  // namespace
}  // namespace depthmocap
