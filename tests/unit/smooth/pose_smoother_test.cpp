#include "libtracker/smooth/pose_smoother.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "libtracker/core/random.h"

namespace depthmocap {
namespace {

constexpr double kFrame_s = 1.0 / 30.0;

TEST(OneEuro, FirstValuePassesAndAConstantStays) {
  OneEuro filter({});
  for (int i = 0; i < 10; ++i) EXPECT_EQ(filter.filter(1.5, i * kFrame_s), 1.5);
}

TEST(OneEuro, ReachesAStepAndForgetsItAfterReset) {
  OneEuro filter({.min_cutoff_hz = 1.0, .beta = 0.0});
  filter.filter(0.0, 0.0);
  const double first = filter.filter(1.0, kFrame_s);
  EXPECT_GT(first, 0.1);
  EXPECT_LT(first, 0.3);
  double value = 0;
  for (int i = 2; i < 90; ++i) value = filter.filter(1.0, i * kFrame_s);
  EXPECT_NEAR(value, 1.0, 1e-3);
  filter.reset();
  EXPECT_EQ(filter.filter(-4.0, 100.0), -4.0);
}

TEST(OneEuro, SpeedRaisesTheCutoff) {
  const auto lagOfRamp = [](double beta) {
    OneEuro filter({.min_cutoff_hz = 1.0, .beta = beta});
    double value = 0;
    for (int i = 0; i < 60; ++i) value = filter.filter(2.0 * i * kFrame_s, i * kFrame_s);
    return 59 * kFrame_s - value / 2.0;
  };
  EXPECT_GT(lagOfRamp(0.0), 0.1);
  EXPECT_LT(lagOfRamp(5.0), 0.02);
}

TEST(OneEuro, IrregularTimesKeepTheTimeConstant) {
  OneEuro often({.min_cutoff_hz = 1.0, .beta = 0.0});
  OneEuro seldom({.min_cutoff_hz = 1.0, .beta = 0.0});
  double a = often.filter(0, 0);
  double b = seldom.filter(0, 0);
  for (int i = 1; i <= 20; ++i) a = often.filter(1, 0.01 * i);
  for (int i = 1; i <= 5; ++i) b = seldom.filter(1, 0.04 * i);
  EXPECT_NEAR(a, b, 0.05);
}

TEST(PoseSmoother, ZeroIsOff) {
  PoseSmoother smoother(0.0);
  EXPECT_FALSE(smoother.on());
  const Pose q = Pose::Constant(0.3);
  smoother.smooth(Pose::Zero(), 0.0);
  EXPECT_EQ(smoother.smooth(q, kFrame_s), q);
}

TEST(PoseSmoother, StrongerIsCalmer) {
  double before = 1e9;
  for (const double strength : {0.25, 0.5, 1.0}) {
    PoseSmoother smoother(strength);
    Random random(3);
    double sum = 0;
    for (int i = 0; i < 300; ++i) {
      Pose q = Pose::Zero();
      for (int d = 0; d < kDofCount; ++d) q[d] = 0.01 * random.normal();
      sum += smoother.smooth(q, i * kFrame_s).norm();
    }
    EXPECT_LT(sum, 0.9 * before) << strength;
    before = sum;
  }
}

TEST(PoseSmoother, HeadingTurnsThroughTheBackWithoutABackSpin) {
  PoseSmoother smoother(0.8);
  for (int i = 0; i < 200; ++i) {
    Pose q = Pose::Zero();
    const double heading = 2.0 + 0.02 * i;
    q[kRootRy] = std::remainder(heading, 2.0 * std::numbers::pi);
    EXPECT_NEAR(smoother.smooth(q, i * kFrame_s)[kRootRy], heading, 0.2) << i;
  }
}

TEST(PoseSmoother, StartsAnewAfterReset) {
  PoseSmoother smoother(1.0);
  smoother.smooth(Pose::Zero(), 0.0);
  smoother.reset();
  const Pose q = Pose::Constant(1.0);
  EXPECT_EQ(smoother.smooth(q, 5.0), q);
}

}  // namespace
}  // namespace depthmocap
