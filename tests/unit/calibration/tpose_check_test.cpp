#include "calibration/tpose_check.h"

#include <cmath>

#include <gtest/gtest.h>

namespace depthmocap {
namespace {

constexpr double kPi = 3.14159265358979;

// A person of sticks: trunk, legs and arms as rows of points. Arms leave the shoulders by these angles [deg] above the
// level; the whole turned by yaw [deg] (positive: the actor's left side comes nearer).
struct Stick {
  double stature = 1.75, distance = 2.6, left_up = 0, right_up = 0, yaw = 0, arm_share = 0.45;
};

std::vector<Eigen::Vector3f> pointsOf(const Stick& stick) {
  std::vector<Eigen::Vector3f> points;
  const double h = stick.stature;
  const auto add = [&](double x, double y, double z) {
    const double a = stick.yaw * kPi / 180;
    points.emplace_back(static_cast<float>(x * std::cos(a) - z * std::sin(a)), static_cast<float>(y - 0.95),
                        static_cast<float>(x * std::sin(a) + z * std::cos(a) - stick.distance));
  };
  for (int i = 0; i <= 600; ++i) {
    const double u = i / 600.0;
    for (const double x : {-0.08, 0.0, 0.08}) add(x, u * h, 0.0);
  }
  for (int i = 0; i <= 300; ++i) {
    const double reach = stick.arm_share * h * i / 300.0;
    for (const double thick : {-0.02, 0.02}) {
      const double left = stick.left_up * kPi / 180;
      const double right = stick.right_up * kPi / 180;
      add(reach * std::cos(left), 0.815 * h + reach * std::sin(left) + thick, 0.0);
      add(-reach * std::cos(right), 0.815 * h + reach * std::sin(right) + thick, 0.0);
    }
  }
  return points;
}

TPoseVerdict verdictOf(const Stick& stick) {
  return checkTPose(MaskImage(320, 240), measureOutline(pointsOf(stick)), {});
}

TEST(TPoseCheck, AcceptsATPose) {
  const TPoseVerdict verdict = verdictOf({});
  EXPECT_TRUE(verdict.good()) << verdict.advice;
  EXPECT_LT(verdict.deviation, 0.06);
  EXPECT_TRUE(verdict.advice.empty());
}

TEST(TPoseCheck, AcceptsSmallAndTallPeopleAndSmallErrors) {
  EXPECT_TRUE(verdictOf({.stature = 1.50}).good());
  EXPECT_TRUE(verdictOf({.stature = 1.98, .distance = 3.2}).good());
  EXPECT_TRUE(verdictOf({.left_up = 8, .right_up = -8, .yaw = 8}).good());
}

TEST(TPoseCheck, TellsToRaiseArmsThatAreLowerThanTheShoulders) {
  const TPoseVerdict verdict = verdictOf({.left_up = -25, .right_up = -25});
  EXPECT_EQ(verdict.fault, TPoseFault::ArmsNotLevel);
  EXPECT_EQ(verdict.advice, "the arms are lower than the shoulders: raise both hands");
}

TEST(TPoseCheck, NamesTheOneArmThatIsWrong) {
  EXPECT_NE(verdictOf({.left_up = -25}).advice.find("the left hand is 25 degrees below"), std::string::npos)
      << verdictOf({.left_up = -25}).advice;
  EXPECT_NE(verdictOf({.right_up = 30}).advice.find("right hand is 30 degrees above"), std::string::npos)
      << verdictOf({.right_up = 30}).advice;
}

TEST(TPoseCheck, TellsATurnedActorWhichWayToTurn) {
  const TPoseVerdict verdict = verdictOf({.yaw = 25});
  EXPECT_EQ(verdict.fault, TPoseFault::Turned);
  EXPECT_EQ(verdict.advice, "turned by 25 degrees: turn to your left until you face the camera");
  EXPECT_NE(verdictOf({.yaw = -25}).advice.find("turn to your right"), std::string::npos);
}

TEST(TPoseCheck, SeesArmsThatHangOrAreBent) {
  EXPECT_EQ(verdictOf({.left_up = -85, .right_up = -85}).fault, TPoseFault::ArmsNotLevel);
  EXPECT_EQ(verdictOf({.arm_share = 0.25}).fault, TPoseFault::ArmsNotOut);
}

TEST(TPoseCheck, RefusesADoll) {
  const TPoseVerdict verdict = verdictOf({.stature = 0.60, .distance = 1.5});
  EXPECT_EQ(verdict.fault, TPoseFault::NoPersonsSize);
  EXPECT_NE(verdict.advice.find("0.60 m tall"), std::string::npos) << verdict.advice;
}

TEST(TPoseCheck, KeepsTheDistance) {
  EXPECT_EQ(verdictOf({.distance = 1.0}).fault, TPoseFault::TooNear);
  EXPECT_EQ(verdictOf({.distance = 5.5}).fault, TPoseFault::TooFar);
}

TEST(TPoseCheck, NamesWhatIsOutOfTheImage) {
  const BodyOutline outline = measureOutline(pointsOf({}));
  MaskImage feet(320, 240);
  for (int x = 150; x < 170; ++x) feet.at(x, 239) = 1;
  EXPECT_EQ(checkTPose(feet, outline, {}).advice, "the feet are out of the image: step back or move to its middle");
  MaskImage hands(320, 240);
  for (int y = 100; y < 110; ++y) hands.at(0, y) = hands.at(319, y) = 1;
  EXPECT_EQ(checkTPose(hands, outline, {}).advice,
            "the left hand and the right hand are out of the image: step back or move to its middle");
}

TEST(TPoseCheckConfig, RefusesImpossibleLimits) {
  TPoseCheckConfig config;
  config.tolerance_rad = 0;
  EXPECT_ANY_THROW(config.validate());
  config = {};
  config.min_distance_m = 5;
  EXPECT_ANY_THROW(config.validate());
}

}  // namespace
}  // namespace depthmocap
