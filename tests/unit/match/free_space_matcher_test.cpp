#include "libtracker/match/free_space_matcher.h"

#include <gtest/gtest.h>

#include "depthmocap/error.h"
#include "depthmocap/world_frame.h"

namespace depthmocap {
namespace {

// A wall-like actor, 2 m away, that fills the middle of the image; nothing is measured around it.
struct Scene {
  CameraModel camera;
  DepthImage depth{640, 480, 0.0F};
  MaskImage mask{640, 480, 0};
  Eigen::Matrix3d R_world_camera = uprightWorldFromCamera();
  Scene() {
    for (int y = 100; y < 380; ++y) {
      for (int x = 220; x < 420; ++x) {
        depth.at(x, y) = 2.0F;
        mask.at(x, y) = 1;
      }
    }
  }
  SurfaceMatches matchOf(const Eigen::Vector3d& p_camera, Part part = Part::Head, bool whole = true) const {
    FreeSpaceMatcher matcher({});
    matcher.observe(depth, mask, camera, R_world_camera);
    PlacedSurface placed;
    placed.parts[static_cast<std::size_t>(partIndex(part))].push_back(
        {(R_world_camera * p_camera).cast<float>(), Eigen::Vector3f::UnitZ(), {}});
    SurfaceMatches matches;
    matcher.match(placed, whole, matches);
    return matches;
  }
};

TEST(FreeSpaceMatcher, SaysHowMuchOfABodyHangsInFreeSpace) {
  const Scene scene;
  FreeSpaceMatcher matcher({});
  EXPECT_EQ(matcher.hanging({}, true, 0.15), 0) << "nothing was observed";
  matcher.observe(scene.depth, scene.mask, scene.camera, scene.R_world_camera);
  const auto placedAt = [&](std::initializer_list<Eigen::Vector3d> points, Part part) {
    PlacedSurface placed;
    for (const Eigen::Vector3d& p : points) {
      placed.parts[static_cast<std::size_t>(partIndex(part))].push_back(
          {(scene.R_world_camera * p).cast<float>(), Eigen::Vector3f::UnitZ(), {}});
    }
    return placed;
  };
  const double margin = FreeSpaceConfig{}.margin_m;
  EXPECT_EQ(matcher.hanging(placedAt({{0, 0, 2.0}, {0, 0, 2.5}}, Part::Head), true, 0.15), 0);
  EXPECT_NEAR(matcher.hanging(placedAt({{0, 0, 2.0 - margin - 0.075}}, Part::Head), true, 0.15), 0.25, 0.01);
  EXPECT_NEAR(matcher.hanging(placedAt({{0, 0, 2.0}, {0, 0, 1.2}}, Part::Head), true, 0.15), 0.5, 1e-6);
  EXPECT_EQ(matcher.hanging(placedAt({{0, 0, 1.2}}, Part::LeftLowerLeg), false, 0.15), 0) << "the mask may lack legs";
}

TEST(FreeSpaceMatcher, AcceptsWhatIsOnTheSurfaceOrHiddenBehindIt) {
  const Scene scene;
  EXPECT_TRUE(scene.matchOf({0, 0, 2.0}).empty());
  EXPECT_TRUE(scene.matchOf({0, 0, 2.5}).empty());
}

TEST(FreeSpaceMatcher, PushesBackWhatStandsBeforeTheMeasuredSurface) {
  const Scene scene;
  const SurfaceMatches matches = scene.matchOf({0, 0, 1.8});
  ASSERT_EQ(matches.size(), 1U);
  // The world's z points to the camera: the target lies behind the point, the margin before the surface.
  EXPECT_NEAR(matches[0].p_world.z(), -(2.0 - FreeSpaceConfig{}.margin_m), 1e-3);
  EXPECT_NEAR(matches[0].n_world.z(), 1.0, 1e-6);
}

TEST(FreeSpaceMatcher, PullsWhatIsOutsideTheOutlineSidewaysIntoIt) {
  const Scene scene;
  const double edge = scene.camera.unproject(420, 240, 2.0).x();
  const SurfaceMatches matches = scene.matchOf({edge + 0.15, 0, 2.0});
  ASSERT_EQ(matches.size(), 1U);
  EXPECT_NEAR(matches[0].p_world.x(), edge + FreeSpaceConfig{}.margin_m, 0.02);
  EXPECT_GT(matches[0].n_world.x(), 0.99);
}

TEST(FreeSpaceMatcher, SaysNothingOutOfViewOrBehindAnObstacle) {
  Scene scene;
  EXPECT_TRUE(scene.matchOf({2.0, 0, 2.0}).empty());
  EXPECT_TRUE(scene.matchOf({0, 0, -1.0}).empty());
  const double edge = scene.camera.unproject(420, 240, 2.0).x();
  for (int y = 0; y < 480; ++y) {
    for (int x = 420; x < 640; ++x) scene.depth.at(x, y) = 1.2F;  // a pillar beside the actor, nearer
  }
  EXPECT_TRUE(scene.matchOf({edge + 0.15, 0, 2.0}).empty());
}

TEST(FreeSpaceMatcher, LeavesLegsFarFromTheOutlineAloneWhereTheMaskMayLackThem) {
  const Scene scene;
  const double edge = scene.camera.unproject(420, 240, 2.0).x();
  const double beside = edge + 0.15;
  for (const Part part : {Part::LeftUpperLeg, Part::RightLowerLeg}) {
    EXPECT_TRUE(scene.matchOf({beside, 0, 2.0}, part, false).empty());
    EXPECT_EQ(scene.matchOf({beside, 0, 2.0}, part, true).size(), 1U);
    EXPECT_EQ(scene.matchOf({edge + 0.07, 0, 2.0}, part, false).size(), 1U);
  }
  EXPECT_EQ(scene.matchOf({beside, 0, 2.0}, Part::LeftLowerArm, false).size(), 1U);
}

TEST(FreeSpaceMatcher, WeighsAFarViolationLess) {
  const Scene scene;
  const SurfaceMatches near = scene.matchOf({0, 0, 1.95});
  const SurfaceMatches far = scene.matchOf({0, 0, 1.5});
  ASSERT_EQ(near.size(), 1U);
  ASSERT_EQ(far.size(), 1U);
  EXPECT_LT(far[0].weight, 0.1 * near[0].weight);
}

TEST(FreeSpaceMatcher, KeepsToItsShareAndIsSilentWithoutAnActor) {
  Scene scene;
  FreeSpaceConfig config;
  config.max_matches = 7;
  PlacedSurface placed;
  for (int i = 0; i < 100; ++i) {
    placed.parts[static_cast<std::size_t>(i % kPartCount)].push_back(
        {Eigen::Vector3f(0.001F * static_cast<float>(i), 0, -1.5F), Eigen::Vector3f::UnitZ(), {}});
  }
  FreeSpaceMatcher matcher(config);
  matcher.observe(scene.depth, scene.mask, scene.camera, scene.R_world_camera);
  SurfaceMatches matches;
  matcher.match(placed, true, matches);
  EXPECT_EQ(matches.size(), 7U);
  scene.mask.reset(640, 480, 0);
  matcher.observe(scene.depth, scene.mask, scene.camera, scene.R_world_camera);
  matches.clear();
  matcher.match(placed, true, matches);
  EXPECT_TRUE(matches.empty());
}

TEST(FreeSpaceConfig, RejectsWhatMakesNoSense) {
  FreeSpaceConfig config;
  config.sigma_m = 0;
  EXPECT_THROW(config.validate(), Error);
  config = {};
  config.max_matches = kMaxSurfaceMatches + 1;
  EXPECT_THROW(config.validate(), Error);
  config = {};
  config.weight = 0;
  EXPECT_THROW(config.validate(), Error);
}

}  // namespace
}  // namespace depthmocap
