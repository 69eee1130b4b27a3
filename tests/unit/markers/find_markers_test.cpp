#include "libtracker/markers/find_markers.h"

#include <cmath>

#include <gtest/gtest.h>

#include "depthmocap/error.h"
#include "libtracker/core/classified_pixels.h"
#include "libtracker/core/random.h"

namespace depthmocap {
namespace {

const std::array<double, kPartCount> kRadii = [] {
  std::array<double, kPartCount> radii{};
  radii.fill(0.08);
  return radii;
}();

// Boxes facing the camera; what a pixel does not give to its part is spread over the others, below the threshold.
struct Scene {
  CameraModel camera;
  ClassifiedPixels pixels;

  explicit Scene(int stride) { pixels.stride = stride; }

  void addBox(Part part, const Eigen::Vector3d& center, double half_width, double half_height, float probability) {
    const Eigen::Vector2d low = camera.project(center - Eigen::Vector3d(half_width, half_height, 0));
    const Eigen::Vector2d high = camera.project(center + Eigen::Vector3d(half_width, half_height, 0));
    for (int y = 0; y < camera.height; y += pixels.stride) {
      for (int x = 0; x < camera.width; x += pixels.stride) {
        if (x < low.x() || x > high.x() || y < low.y() || y > high.y()) continue;
        addPixel(part, x, y, center.z(), probability);
      }
    }
  }
  void addPixel(Part part, int x, int y, double depth, float probability) {
    ClassifiedPixels::Pixel pixel;
    pixel.x = static_cast<std::int16_t>(x);
    pixel.y = static_cast<std::int16_t>(y);
    pixel.depth_m = static_cast<float>(depth);
    pixel.probability.fill((1.0F - probability) / (kPartCount - 1));
    pixel.probability[static_cast<std::size_t>(partIndex(part))] = probability;
    pixels.pixels.push_back(pixel);
  }
};

MarkerSet findIn(const Scene& scene, const MarkerConfig& config, const MarkerSet* prediction = nullptr) {
  MarkerFinder finder(config);
  MarkerSet markers;
  finder.find(scene.pixels, scene.camera, kRadii, prediction, markers);
  return markers;
}

MarkerConfig onSurface() {
  MarkerConfig config;
  config.push_in = false;
  return config;
}

constexpr int kHead = partIndex(Part::Head);

TEST(FindMarkers, ModeIsTheMiddleOfABlob) {
  Scene scene(2);
  const Eigen::Vector3d center(0.3, -0.4, 2.2);
  scene.addBox(Part::Head, center, 0.09, 0.1, 0.8F);
  const MarkerSet markers = findIn(scene, onSurface());
  EXPECT_LT((markers.position.col(kHead) - center).norm(), 0.005);
  EXPECT_GT(markers.confidence[kHead], 0.6);
  EXPECT_LE(markers.confidence[kHead], 1.0);
  EXPECT_EQ(markers.seenCount(), 1);
}

TEST(FindMarkers, PushInMovesAlongTheViewingRayByTheRadius) {
  Scene scene(2);
  scene.addBox(Part::Head, {0.5, -0.6, 2.0}, 0.09, 0.1, 0.8F);
  const Eigen::Vector3d surface = findIn(scene, onSurface()).position.col(kHead);
  const Eigen::Vector3d inside = findIn(scene, MarkerConfig{}).position.col(kHead);
  EXPECT_LT((inside - (surface + 0.08 * surface.normalized())).norm(), 1e-9);
}

TEST(FindMarkers, ScatteredOutliersDoNotMoveTheMode) {
  Scene scene(2);
  const Eigen::Vector3d center(0, 0.2, 2.0);
  scene.addBox(Part::Head, center, 0.09, 0.1, 0.7F);
  const std::size_t inliers = scene.pixels.pixels.size();
  Random random(3);
  for (std::size_t i = 0; i < inliers / 2; ++i) {
    scene.addPixel(Part::Head, static_cast<int>(random.below(640)), static_cast<int>(random.below(480)),
                   random.uniform(1.5, 3.0), 0.7F);
  }
  EXPECT_LT((findIn(scene, onSurface()).position.col(kHead) - center).norm(), 0.015);
}

TEST(FindMarkers, LongLimbGivesItsMiddleDespiteNoise) {
  const Eigen::Vector3d center(0.1, 0.5, 2.5);
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    Scene scene(2);
    scene.addBox(Part::LeftUpperLeg, center, 0.07, 0.2, 0.6F);
    Random random(seed);
    for (auto& pixel : scene.pixels.pixels) {
      pixel.probability[static_cast<std::size_t>(partIndex(Part::LeftUpperLeg))] =
          static_cast<float>(random.uniform(0, 1));
    }
    EXPECT_LT((findIn(scene, onSurface()).position.col(partIndex(Part::LeftUpperLeg)) - center).norm(), 0.02);
  }
}

TEST(FindMarkers, TooLittleSurfaceGivesNoMarker) {
  Scene scene(2);
  scene.addBox(Part::Head, {0, 0, 2.0}, 0.02, 0.02, 0.9F);  // 16 cm^2 * 0.9 < 20 cm^2
  EXPECT_EQ(findIn(scene, MarkerConfig{}).seenCount(), 0);
  scene.addBox(Part::Head, {0.04, 0, 2.0}, 0.02, 0.02, 0.9F);
  EXPECT_EQ(findIn(scene, MarkerConfig{}).seenCount(), 1);
}

TEST(FindMarkers, UnsurePixelsDoNotVote) {
  Scene scene(2);
  scene.addBox(Part::Head, {0, 0, 2.0}, 0.2, 0.2, 0.14F);
  EXPECT_EQ(findIn(scene, MarkerConfig{}).seenCount(), 0);
}

TEST(FindMarkers, EmptyAndUnmeasuredPixelsGiveNothing) {
  Scene scene(2);
  EXPECT_EQ(findIn(scene, MarkerConfig{}).seenCount(), 0);
  for (int x = 0; x < 640; ++x) scene.addPixel(Part::Head, x, 100, 0.0, 1.0F);
  EXPECT_EQ(findIn(scene, MarkerConfig{}).seenCount(), 0);
}

TEST(FindMarkers, LargerModeWinsAndARivalLowersConfidence) {
  Scene scene(2);
  scene.addBox(Part::LeftLowerArm, {-0.4, 0, 2.0}, 0.08, 0.05, 0.7F);
  const double alone = findIn(scene, onSurface()).confidence[partIndex(Part::LeftLowerArm)];
  scene.addBox(Part::LeftLowerArm, {0.4, 0, 2.0}, 0.06, 0.05, 0.7F);
  const MarkerSet both = findIn(scene, onSurface());
  EXPECT_LT(both.position(0, partIndex(Part::LeftLowerArm)), -0.35);
  EXPECT_LT(both.confidence[partIndex(Part::LeftLowerArm)], 0.8 * alone);
}

TEST(FindMarkers, PredictionDecidesBetweenSimilarModesOnly) {
  const int part = partIndex(Part::LeftLowerArm);
  MarkerSet prediction;
  prediction.position.col(part) = Eigen::Vector3d(0.4, 0, 2.0);
  prediction.confidence[part] = 1;
  Scene similar(2);
  similar.addBox(Part::LeftLowerArm, {-0.4, 0, 2.0}, 0.08, 0.05, 0.7F);
  similar.addBox(Part::LeftLowerArm, {0.4, 0, 2.0}, 0.07, 0.05, 0.7F);
  EXPECT_LT(findIn(similar, onSurface()).position(0, part), 0);
  EXPECT_GT(findIn(similar, onSurface(), &prediction).position(0, part), 0.35);
  Scene clear(2);
  clear.addBox(Part::LeftLowerArm, {-0.4, 0, 2.0}, 0.08, 0.08, 0.9F);
  clear.addBox(Part::LeftLowerArm, {0.4, 0, 2.0}, 0.03, 0.05, 0.7F);
  EXPECT_LT(findIn(clear, onSurface(), &prediction).position(0, part), -0.35);
}

TEST(FindMarkers, PredictionAloneMakesNoMarker) {
  Scene scene(2);
  scene.addBox(Part::Torso, {0, 0, 2.0}, 0.15, 0.2, 0.9F);
  MarkerSet prediction;
  prediction.position.col(kHead) = Eigen::Vector3d(0, -0.4, 2.0);
  prediction.confidence[kHead] = 1;
  EXPECT_FALSE(findIn(scene, MarkerConfig{}, &prediction).seen(kHead));
}

TEST(FindMarkers, ResultDoesNotDependOnTheStride) {
  Scene fine(1);
  Scene coarse(3);
  for (Scene* scene : {&fine, &coarse}) scene->addBox(Part::Torso, {0.2, 0.1, 2.6}, 0.17, 0.2, 0.6F);
  const MarkerSet a = findIn(fine, MarkerConfig{});
  const MarkerSet b = findIn(coarse, MarkerConfig{});
  const int torso = partIndex(Part::Torso);
  EXPECT_LT((a.position.col(torso) - b.position.col(torso)).norm(), 0.006);
  EXPECT_NEAR(a.confidence[torso], b.confidence[torso], 0.05);
}

TEST(FindMarkers, ReusedFinderGivesTheSameBytes) {
  Scene first(2);
  first.addBox(Part::Torso, {0.2, 0.1, 2.6}, 0.17, 0.2, 0.6F);
  Scene second(2);
  second.addBox(Part::Torso, {-0.4, 0.3, 1.6}, 0.17, 0.2, 0.6F);
  MarkerFinder finder{MarkerConfig{}};
  MarkerSet once;
  MarkerSet again;
  finder.find(first.pixels, first.camera, kRadii, nullptr, once);
  finder.find(second.pixels, second.camera, kRadii, nullptr, again);
  finder.find(first.pixels, first.camera, kRadii, nullptr, again);
  EXPECT_EQ(once.position, again.position);
  EXPECT_EQ(once.confidence, again.confidence);
}

TEST(MarkerConfig, ErrorNamesFieldAndRule) {
  MarkerConfig config;
  config.bandwidth_m = 0;
  try {
    MarkerFinder finder(config);
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("bandwidth_m"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("above 0 and below 1"), std::string::npos);
  }
}

TEST(MeanShift, KernelIsTheGaussianOfThePaper) {
  PartVotes votes;
  votes.x = {0.0F};
  votes.y = {0.0F};
  votes.z = {2.0F};
  votes.weight = {1.0F};
  votes.area = {1.0F};
  MeanShift mean_shift;
  for (float distance = 0; distance < 0.5F; distance += 0.01F) {
    const float density = mean_shift.density(votes, {distance, 0, 2.0F}, 0.07F);
    EXPECT_NEAR(density, std::exp(-distance * distance / (0.07F * 0.07F)), 0.01F);
  }
}

}  // namespace
}  // namespace depthmocap
