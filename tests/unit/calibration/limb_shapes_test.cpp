#include "calibration/limb_shapes.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "libtracker/core/random.h"

namespace depthmocap {
namespace {

using Eigen::Vector3d;

// The half of an elliptic tube that faces the camera at the world's origin, z towards it, with pixels evenly between
// its outlines; with noise [m] in depth, which comes in steps [m] (0 = none).
std::vector<Eigen::Vector3f> halfTube(const Vector3d& center, const Vector3d& axis, const Vector3d& side, double a,
                                      double b, double length, double noise_m, double step_m = 0) {
  const Vector3d front = side.cross(axis);
  Random random(3);
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < 4000; ++i) {
    const double across = random.uniform(-1.0, 1.0);
    Vector3d p = center + axis * random.uniform(-0.5, 0.5) * length + side * (a * across) +
                 front * (b * std::sqrt(1.0 - across * across)) + Vector3d(0, 0, noise_m * random.normal());
    if (step_m > 0) p.z() = step_m * std::round(p.z() / step_m);
    points.push_back(p.cast<float>());
  }
  return points;
}

TEST(FitCylinder, FindsAxisAndRadiusOfANoisyHalf) {
  const Vector3d axis = Vector3d(1, 0.1, 0).normalized();
  const Vector3d side = axis.cross(Vector3d::UnitZ()).normalized();
  const auto points = halfTube({0.4, 0.3, -2.5}, axis, side, 0.045, 0.045, 0.25, 0.002);
  const auto cylinder = fitCylinder(points, Vector3d::UnitX(), {});
  ASSERT_TRUE(cylinder);
  EXPECT_NEAR(cylinder->radius, 0.045, 0.006);
  EXPECT_GT(cylinder->axis.dot(axis), std::cos(0.08));
  EXPECT_NEAR(cylinder->high - cylinder->low, 0.25, 0.02);
  EXPECT_GT(cylinder->inlier_share, 0.9);
}

// Kinect v1 at 3 m: steps of 26 mm and 8 mm of noise, on limbs of 4 to 9 cm radius.
TEST(FitCylinder, FindsALimbThatIsHardlyThickerThanADepthStep) {
  for (const double radius : {0.035, 0.05, 0.09}) {
    const auto points =
        halfTube({0.4, 0.3, -3.0}, Vector3d::UnitX(), Vector3d::UnitY(), radius, radius, 0.25, 0.008, 0.026);
    const auto cylinder = fitCylinder(points, Vector3d::UnitX(), {});
    ASSERT_TRUE(cylinder) << radius;
    EXPECT_NEAR(cylinder->radius, radius, 0.008);
    EXPECT_GT(cylinder->axis.x(), std::cos(0.06));
    EXPECT_LT((cylinder->point - Vector3d(0.4, 0.3, -3.0)).tail<2>().norm(), 0.026);  // a depth step
  }
}

TEST(FitCylinder, LooksPastStrayPoints) {
  const Vector3d axis = Vector3d::UnitX();
  auto points = halfTube({0.4, 0.3, -2.5}, axis, Vector3d::UnitY(), 0.06, 0.06, 0.3, 0.001);
  Random random(4);
  for (int i = 0; i < 900; ++i) {
    points.emplace_back(static_cast<float>(random.uniform(0.2, 0.6)), static_cast<float>(random.uniform(0.1, 0.5)),
                        -2.6F);
  }
  const auto cylinder = fitCylinder(points, axis, {});
  ASSERT_TRUE(cylinder);
  EXPECT_NEAR(cylinder->radius, 0.06, 0.012);
  EXPECT_LT(std::abs(cylinder->point.y() - 0.3), 0.01);
}

TEST(FitCylinder, IsTheSameEveryTime) {
  const auto points = halfTube({0, 0, -2}, Vector3d::UnitX(), Vector3d::UnitY(), 0.05, 0.05, 0.3, 0.003);
  const auto a = fitCylinder(points, Vector3d::UnitX(), {});
  const auto b = fitCylinder(points, Vector3d::UnitX(), {});
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->radius, b->radius);
  EXPECT_EQ(a->point, b->point);
}

TEST(FitCylinder, GivesNothingForTooFewPointsOrAPlane) {
  EXPECT_FALSE(fitCylinder({{0, 0, -2}, {0.1F, 0, -2}}, Vector3d::UnitX(), {}));
  std::vector<Eigen::Vector3f> plane;
  for (int i = 0; i < 400; ++i) {
    plane.emplace_back(0.03F * static_cast<float>(i % 20), 0.03F * static_cast<float>(i / 20), -2.0F);
  }
  EXPECT_FALSE(fitCylinder(plane, Vector3d::UnitX(), {}));
}

TEST(FitEllipticCylinder, FindsWidthAndDepthOfAHalf) {
  const auto points = halfTube({0.1, 0.2, -2.6}, Vector3d::UnitY(), Vector3d::UnitX(), 0.16, 0.11, 0.4, 0.002);
  const auto trunk = fitEllipticCylinder(points, Vector3d::UnitY(), {});
  ASSERT_TRUE(trunk);
  EXPECT_NEAR(trunk->half_width, 0.16, 0.006);
  EXPECT_NEAR(trunk->half_depth, 0.11, 0.008);
  EXPECT_LT((trunk->center - Vector3d(0.1, 0.2, -2.6)).norm(), 0.02);
}

// The side that the camera does not see is no deeper than a trunk can be, and the front stays where it is seen.
TEST(FitEllipticCylinder, KeepsATrunkThatAKinect1SeesAt3MetresAtItsPlace) {
  const Vector3d axis = Vector3d(0.05, 1, -0.1).normalized();
  const Vector3d side = Vector3d(Vector3d::UnitX() - axis.x() * axis).normalized();
  const auto points = halfTube({0, 0.2, -3.0}, axis, side, 0.17, 0.12, 0.35, 0.008, 0.026);
  const auto trunk = fitEllipticCylinder(points, Vector3d::UnitY(), {});
  ASSERT_TRUE(trunk);
  EXPECT_GT(trunk->axis.dot(axis), std::cos(0.06));
  EXPECT_LT(std::abs(trunk->side.dot(trunk->axis)), 1e-9);
  EXPECT_NEAR(trunk->half_width, 0.17, 0.01);
  EXPECT_NEAR(trunk->half_depth, 0.12, 0.015);
  EXPECT_NEAR(trunk->center.z() + trunk->half_depth, -3.0 + 0.12, 0.02);
}

TEST(FitEllipticCylinder, GivesNothingForTooFewPoints) {
  EXPECT_FALSE(fitEllipticCylinder({{0, 0, -2}}, Vector3d::UnitY(), {}));
}

TEST(LimbOutline, LooksPastStrayPointsBeyondTheEnds) {
  auto points = halfTube({0, 0, -2.5}, Vector3d::UnitY(), Vector3d::UnitX(), 0.08, 0.08, 0.4, 0.002);
  for (int i = 0; i < 4; ++i) points.emplace_back(0.3F, -0.9F, -2.5F);
  const auto outline = limbOutline(points, Vector3d::UnitY());
  ASSERT_TRUE(outline);
  EXPECT_NEAR(outline->half_width, 0.08, 0.006);
  EXPECT_NEAR(outline->high - outline->low, 0.4, 0.02);
  EXPECT_NEAR(outline->middle.x(), 0, 0.005);
}

}  // namespace
}  // namespace depthmocap
