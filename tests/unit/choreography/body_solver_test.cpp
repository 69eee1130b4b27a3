#include "libtracker/choreography/body_solver.h"

#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include "libtracker/skeleton/forward_kinematics.h"
#include "libtracker/skeleton/joint_limits.h"

namespace depthmocap {
namespace {

const Skeleton& skeleton() {
  static const Skeleton average = makeSkeleton(BoneLengths{});
  return average;
}

BodyFrame standingFrame() {
  BodyFrame frame;
  frame.pelvis.y = -0.06;
  frame.left_foot.x = 0.12;
  frame.right_foot.x = -0.12;
  return frame;
}

Eigen::Vector3d joint(const Pose& q, Joint j) {
  return jointPositions(skeleton(), q).col(static_cast<int>(j));
}

TEST(BodySolver, StandsFlatOnTheFloor) {
  const Pose q = solveBody(skeleton(), standingFrame());
  const Sole sole = soleOf(skeleton());
  EXPECT_NEAR(joint(q, Joint::LeftAnkle).y(), sole.ankle_height, 1e-6);
  EXPECT_NEAR(joint(q, Joint::LeftToe).y(), sole.ankle_height + skeleton().left_toe.y(), 1e-6);
  EXPECT_NEAR(joint(q, Joint::RightAnkle).x(), -0.12, 1e-6);
  EXPECT_GT(joint(q, Joint::LeftKnee).z(), joint(q, Joint::LeftAnkle).z());
}

TEST(BodySolver, SoleOfAFlatFootIsLevel) {
  const Sole sole = soleOf(skeleton());
  EXPECT_DOUBLE_EQ(sole.ball.y(), sole.heel.y());
  EXPECT_GT(sole.ankle_height, 0.05);
  EXPECT_NEAR(standingPelvisHeight(skeleton()), 0.9464, 1e-3);
}

TEST(BodySolver, PitchRollsOverToeAndHeel) {
  const Sole sole = soleOf(skeleton());
  FootState foot;
  foot.heading = 0.4;
  const auto place = [&](double pitch, const Eigen::Vector3d& point) {
    const Eigen::Matrix3d R =
        (Eigen::AngleAxisd(foot.heading, Eigen::Vector3d::UnitY()) * Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitX()))
            .toRotationMatrix();
    return Eigen::Vector3d(anklePosition(sole, foot, pitch) + R * point);
  };
  EXPECT_LT((place(0.8, sole.toe) - place(0.0, sole.toe)).norm(), 1e-12);
  EXPECT_LT((place(-0.4, sole.heel) - place(0.0, sole.heel)).norm(), 1e-12);
}

TEST(BodySolver, FeetStayWhenThePelvisMoves) {
  BodyFrame frame = standingFrame();
  const Pose before = solveBody(skeleton(), frame);
  frame.pelvis.x += 0.06;
  frame.pelvis.y -= 0.15;
  frame.pelvis.heading = 0.3;
  frame.pelvis.lean = 0.3;
  const Pose after = solveBody(skeleton(), frame);
  for (const Joint j : {Joint::LeftAnkle, Joint::RightAnkle}) {
    EXPECT_LT((joint(before, j) - joint(after, j)).norm(), 1e-6);
  }
  for (const Joint j : {Joint::LeftToe, Joint::RightToe}) EXPECT_LT((joint(before, j) - joint(after, j)).norm(), 1e-4);
}

TEST(BodySolver, ShortLegLiftsItsHeelAndKeepsItsToe) {
  BodyFrame frame = standingFrame();
  frame.right_foot.z = -0.45;
  frame.right_foot.heel_rise = 0.9;
  const Pose q = solveBody(skeleton(), frame);
  const Sole sole = soleOf(skeleton());
  EXPECT_GT(joint(q, Joint::RightAnkle).y(), sole.ankle_height + 0.01);
  EXPECT_NEAR(joint(q, Joint::RightToe).z(), -0.45 + sole.toe.z(), 2e-3);
}

TEST(BodySolver, HighestPelvisIsJustReachable) {
  BodyFrame frame = standingFrame();
  frame.left_foot.z = 0.35;
  frame.right_foot.z = -0.35;
  frame.pelvis.y = highestPelvis(skeleton(), frame);
  const Pose q = solveBody(skeleton(), frame);
  EXPECT_NEAR(joint(q, Joint::LeftAnkle).z(), 0.35, 1e-4);
  EXPECT_LT(q[kLtibiaRx], 0.25);
}

TEST(BodySolver, CenterOfMassIsInTheMiddleOfTheTPose) {
  const Eigen::Vector3d center = centerOfMass(skeleton(), Pose::Zero());
  EXPECT_NEAR(center.x(), 0.0, 1e-9);
  EXPECT_GT(center.y(), -0.05);
  EXPECT_LT(center.y(), 0.2);
}

}  // namespace
}  // namespace depthmocap
