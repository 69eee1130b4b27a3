#include "libtracker/classify/side_expectation.h"

#include <gtest/gtest.h>

#include "depthmocap/parts.h"
#include "libtracker/core/classified_pixels.h"

namespace depthmocap {
namespace {

constexpr auto kLeft = static_cast<std::size_t>(partIndex(Part::LeftLowerLeg));
constexpr auto kRight = static_cast<std::size_t>(partIndex(Part::RightLowerLeg));
constexpr auto kTorso = static_cast<std::size_t>(partIndex(Part::Torso));

// Shins that stand upright, the left one 0.3 m to the right in the image.
JointPositions twoShins() {
  JointPositions joints = JointPositions::Zero();
  joints.row(2).setConstant(2.0);
  joints.col(static_cast<int>(Joint::LeftKnee)) << 0.15, 0.5, 2.0;
  joints.col(static_cast<int>(Joint::LeftAnkle)) << 0.15, 0.9, 2.0;
  joints.col(static_cast<int>(Joint::RightKnee)) << -0.15, 0.5, 2.0;
  joints.col(static_cast<int>(Joint::RightAnkle)) << -0.15, 0.9, 2.0;
  return joints;
}

ClassifiedPixels onePixel(const CameraModel& camera, const Eigen::Vector3d& p, float left, float right) {
  ClassifiedPixels pixels;
  auto& pixel = pixels.pixels.emplace_back();
  const Eigen::Vector2d at = camera.project(p);
  pixel.x = static_cast<std::int16_t>(at.x());
  pixel.y = static_cast<std::int16_t>(at.y());
  pixel.depth_m = static_cast<float>(p.z());
  pixel.probability[kLeft] = left;
  pixel.probability[kRight] = right;
  pixel.probability[kTorso] = 1.0F - left - right;
  return pixels;
}

TEST(ExpectSides, GivesADoubtfulPixelToTheNearerLimb) {
  const CameraModel camera;
  auto pixels = onePixel(camera, {0.15, 0.7, 2.0}, 0.35F, 0.45F);
  expectSides(twoShins(), camera, 1, pixels);
  const auto& p = pixels.pixels[0].probability;
  EXPECT_GT(p[kLeft], 3 * p[kRight]);
}

TEST(ExpectSides, MovesNothingToOtherParts) {
  const CameraModel camera;
  auto pixels = onePixel(camera, {0.15, 0.7, 2.0}, 0.35F, 0.45F);
  expectSides(twoShins(), camera, 1, pixels);
  const auto& p = pixels.pixels[0].probability;
  EXPECT_NEAR(p[kLeft] + p[kRight], 0.8F, 1e-5F);
  EXPECT_EQ(p[kTorso], 1.0F - 0.35F - 0.45F);
}

TEST(ExpectSides, LeavesASureClassifierItsAnswer) {
  const CameraModel camera;
  auto pixels = onePixel(camera, {0.15, 0.7, 2.0}, 0.01F, 0.98F);
  expectSides(twoShins(), camera, 1, pixels);
  EXPECT_GT(pixels.pixels[0].probability[kRight], 0.8F);
}

TEST(ExpectSides, SaysNothingFarFromBoth) {
  const CameraModel camera;
  auto pixels = onePixel(camera, {0.0, -0.8, 2.0}, 0.3F, 0.5F);
  expectSides(twoShins(), camera, 1, pixels);
  EXPECT_NEAR(pixels.pixels[0].probability[kLeft], 0.3F, 1e-3F);
}

}  // namespace
}  // namespace depthmocap
