#include "libtracker/tracker/upright_world.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "depthmocap/world_frame.h"

namespace depthmocap {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

// The floor as a camera sees it that looks down by `pitch` and leans to its right by `roll`.
Segmentation floorOf(double pitch_deg, double roll_deg = 0, double height_m = 1.4) {
  const Eigen::Matrix3d R_camera_level = (Eigen::AngleAxisd(-roll_deg * kDegree, Eigen::Vector3d::UnitZ()) *
                                          Eigen::AngleAxisd(pitch_deg * kDegree, Eigen::Vector3d::UnitX()))
                                             .toRotationMatrix();
  Segmentation seen;
  seen.floor_camera.emplace();
  *seen.floor_camera << R_camera_level * Eigen::Vector3d(0, -1, 0), height_m;
  seen.floor_area_m2 = 5;
  return seen;
}

double turnedBy(const UprightWorld& world) {
  return Eigen::AngleAxisd(world.R_world_camera() * uprightWorldFromCamera().transpose()).angle() / kDegree;
}

TEST(UprightWorld, IsTheCamerasOwnWithoutAFloor) {
  UprightWorld world;
  EXPECT_FALSE(world.observe(Segmentation{}).has_value());
  EXPECT_EQ(world.R_world_camera(), uprightWorldFromCamera());
  EXPECT_FALSE(world.floor().has_value());
}

TEST(UprightWorld, StandsUprightOverTheFloorOfATiltedCamera) {
  UprightWorld world;
  const Segmentation seen = floorOf(20, 5);
  EXPECT_TRUE(world.observe(seen).has_value());
  EXPECT_LT((world.R_world_camera() * seen.floor_camera->head<3>() - Eigen::Vector3d::UnitY()).norm(), 1e-9);
  EXPECT_NEAR((world.R_world_camera() * Eigen::Vector3d::UnitZ()).x(), 0, 1e-9) << "the camera looks along -z";
  EXPECT_LT((world.R_world_camera() * Eigen::Vector3d::UnitZ()).z(), -0.9);
  EXPECT_TRUE((world.R_world_camera() * world.R_world_camera().transpose()).isIdentity(1e-9));
  EXPECT_NEAR(world.R_world_camera().determinant(), 1, 1e-9);
  ASSERT_TRUE(world.floor().has_value());
  EXPECT_LT((*world.floor() - Eigen::Vector4d(0, 1, 0, 1.4)).norm(), 1e-9);
}

TEST(UprightWorld, LeavesALevelCameraAsItIs) {
  UprightWorld world;
  EXPECT_FALSE(world.observe(floorOf(0.5, 0.4)).has_value());
  EXPECT_EQ(world.R_world_camera(), uprightWorldFromCamera());
  EXPECT_TRUE(world.floor().has_value());
}

TEST(UprightWorld, DoesNotWobbleWithTheFloorThatIsFound) {
  UprightWorld world;
  world.observe(floorOf(12));
  const Eigen::Matrix3d first = world.R_world_camera();
  for (int i = 0; i < 20; ++i)
    EXPECT_FALSE(world.observe(floorOf(12 + 0.4 * std::sin(i), 0, 1.4 + 0.01 * std::cos(i))).has_value());
  EXPECT_EQ(world.R_world_camera(), first);
  EXPECT_NEAR((*world.floor())[3], 1.4, 0.005) << "the mean of what was found";
}

TEST(UprightWorld, OneStrayFloorDoesNotTurnIt) {
  UprightWorld world;
  world.observe(floorOf(12));
  EXPECT_FALSE(world.observe(floorOf(20)).has_value());
  EXPECT_FALSE(world.observe(floorOf(12)).has_value());
  EXPECT_FALSE(world.observe(floorOf(20)).has_value());
  EXPECT_NEAR(turnedBy(world), 12, 1e-6);
}

TEST(UprightWorld, FollowsACameraThatWasTurned) {
  UprightWorld world;
  world.observe(floorOf(12));
  EXPECT_FALSE(world.observe(floorOf(20)).has_value());
  EXPECT_TRUE(world.observe(floorOf(20.1)).has_value());
  EXPECT_NEAR(turnedBy(world), 20, 0.1);
}

TEST(UprightWorld, TheSamePlaneInTheNextFrameIsNoSecondWitness) {
  UprightWorld world;
  world.observe(floorOf(12));
  for (int i = 0; i < 30; ++i) EXPECT_FALSE(world.observe(floorOf(20)).has_value());
}

TEST(UprightWorld, DoesNotTrustALap) {
  UprightWorld world;
  Segmentation seen = floorOf(20);
  seen.floor_area_m2 = 0.3;
  EXPECT_FALSE(world.observe(seen).has_value());
  EXPECT_FALSE(world.floor().has_value());
}

TEST(UprightWorld, HasNoFloorWhereThePictureHasNone) {
  UprightWorld world;
  world.observe(floorOf(20));
  EXPECT_FALSE(world.observe(Segmentation{}).has_value());
  EXPECT_FALSE(world.floor().has_value());
  EXPECT_NEAR(turnedBy(world), 20, 1e-6) << "up stays where it was";
}

}  // namespace
}  // namespace depthmocap
