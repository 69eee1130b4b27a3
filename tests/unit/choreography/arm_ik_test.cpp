#include "libtracker/choreography/arm_ik.h"

#include <gtest/gtest.h>

#include "libtracker/skeleton/joint_limits.h"

namespace depthmocap {
namespace {

const Skeleton& skeleton() {
  static const Skeleton average = makeSkeleton(BoneLengths{});
  return average;
}

Eigen::Vector3d vectorOf(const HandTarget& t) {
  return {t.out, t.up, t.forward};
}

TEST(ArmIk, ReachesTargetsInFrontOfTheBody) {
  int count = 0;
  for (double out = -0.20; out <= 0.45; out += 0.08) {
    for (double up = -0.45; up <= 0.50; up += 0.08) {
      for (double forward = 0.12; forward <= 0.45; forward += 0.08) {
        const HandTarget target{out, up, forward, 0.0};
        const double distance = vectorOf(target).norm();
        if (distance > 0.50 || distance < 0.22) continue;
        const Eigen::Vector3d wrist = wristOf(skeleton(), reachArm(skeleton(), target));
        EXPECT_LT((wrist - vectorOf(target)).norm(), 0.02) << out << " " << up << " " << forward;
        ++count;
      }
    }
  }
  EXPECT_GT(count, 100);
}

TEST(ArmIk, StretchesTowardsATargetOutOfReach) {
  const HandTarget target{0.6, 0.0, 1.0, 0.0};
  const Eigen::Vector3d wrist = wristOf(skeleton(), reachArm(skeleton(), target));
  EXPECT_GT(wrist.normalized().dot(vectorOf(target).normalized()), 0.99);
  EXPECT_GT(wrist.norm(), 0.52);
}

TEST(ArmIk, ElbowTurnLiftsTheElbowOutwards) {
  HandTarget target{0.0, 0.0, 0.35, 0.0};
  const double relaxed = reachArm(skeleton(), target).swing_z;
  target.elbow = 0.8;
  EXPECT_GT(reachArm(skeleton(), target).swing_z, relaxed + 0.2);
  EXPECT_LT((wristOf(skeleton(), reachArm(skeleton(), target)) - vectorOf(target)).norm(), 0.02);
}

TEST(ArmIk, ClavicleFollowsTheRaisedArm) {
  const double low = reachArm(skeleton(), {0.1, -0.5, 0.05, 0}).clavicle_z;
  const double high = reachArm(skeleton(), {0.1, 0.5, 0.05, 0}).clavicle_z;
  EXPECT_GT(high - low, 0.3);
}

TEST(ArmIk, MovesSmoothlyWithTheTarget) {
  // Along a circle around the body in reach, neighbouring targets give neighbouring angles.
  ArmAngles last;
  for (int i = 0; i <= 400; ++i) {
    const double a = 2 * 3.14159265 * i / 400;
    const ArmAngles arm = reachArm(skeleton(), {0.15 + 0.2 * std::cos(a), 0.3 * std::sin(a), 0.25, 0.0});
    if (i > 0) {
      EXPECT_LT(std::abs(arm.twist - last.twist), 0.12) << i;
      EXPECT_LT(std::abs(arm.swing_y - last.swing_y) + std::abs(arm.swing_z - last.swing_z), 0.12) << i;
      EXPECT_LT(std::abs(arm.elbow - last.elbow), 0.12) << i;
    }
    last = arm;
  }
}

TEST(ArmIk, SwingArmForwardIsForward) {
  EXPECT_GT(wristOf(skeleton(), swingArm(0.6, 0.1, 0.3)).z(), 0.25);
  EXPECT_LT(wristOf(skeleton(), swingArm(-0.5, 0.1, 0.1)).z(), -0.15);
  EXPECT_GT(wristOf(skeleton(), swingArm(0.0, 0.9, 0.1)).x(), 0.35);
}

}  // namespace
}  // namespace depthmocap
