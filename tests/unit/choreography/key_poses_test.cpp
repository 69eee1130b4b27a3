#include "libtracker/choreography/key_poses.h"

#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

#include "libtracker/choreography/postures.h"

namespace depthmocap {
namespace {

constexpr Performance kExact{.tempo = 1.0, .hand_spread = 0.0, .angle_spread = 0.0, .heel_rise = 0.0};

const Skeleton& skeleton() {
  static const Skeleton average = makeSkeleton(BoneLengths{});
  return average;
}

TEST(KeyPoses, PassesThroughItsKeys) {
  KeySequence s;
  s.add(standing(), 0.0);
  s.add(standing(), 1.0).spine.twist = 0.5;
  s.add(standing(), 1.0).pelvis.y = -0.2;
  Random random(1);
  const BodyFrames frames = playKeys(skeleton(), s, kExact, random);
  ASSERT_EQ(frames.size(), 61U);
  EXPECT_NEAR(frames[30].spine.twist, 0.5, 1e-9);
  EXPECT_NEAR(frames[60].pelvis.y, -0.2, 1e-9);
  for (const BodyFrame& frame : frames) {
    EXPECT_LE(frame.spine.twist, 0.5 + 1e-9);
    EXPECT_GE(frame.spine.twist, -1e-9);
  }
}

TEST(KeyPoses, TempoShortensTheMotion) {
  KeySequence s;
  s.add(standing(), 0.0);
  s.add(standing(), 2.0);
  Performance fast = kExact;
  fast.tempo = 2.0;
  Random random(1);
  EXPECT_EQ(playKeys(skeleton(), s, fast, random).size(), 31U);
}

TEST(KeyPoses, AFootThatMovesIsLifted) {
  KeySequence s;
  s.add(standing(), 0.0);
  s.add(standing(), 1.0).left_foot.forward = 0.4;
  Random random(1);
  const BodyFrames frames = playKeys(skeleton(), s, kExact, random);
  EXPECT_GT(frames[15].left_foot.lift, 0.05);
  EXPECT_EQ(frames[15].right_foot.lift, 0.0);
  EXPECT_NEAR(frames[30].left_foot.lift, 0.0, 1e-9);
  EXPECT_NEAR(frames[30].left_foot.z, 0.4, 1e-9);
}

TEST(KeyPoses, FeetStepOneAfterTheOtherUnlessTheyHop) {
  KeySequence s;
  s.add(standing(), 0.0);
  KeyPose& key = s.add(standing(), 1.0);
  key.left_foot.forward = key.right_foot.forward = 0.3;
  Random random(1);
  Performance hop = kExact;
  hop.hops = true;
  const BodyFrames steps = playKeys(skeleton(), s, kExact, random);
  const BodyFrames hops = playKeys(skeleton(), s, hop, random);
  double both = 0;
  for (const BodyFrame& frame : steps) both = std::max(both, std::min(frame.left_foot.lift, frame.right_foot.lift));
  EXPECT_LT(both, 1e-9);
  EXPECT_GT(std::min(hops[15].left_foot.lift, hops[15].right_foot.lift), 0.02);
}

TEST(KeyPoses, RefusesKeysOutOfOrderAndSequencesWithoutMotion) {
  KeySequence s;
  EXPECT_THROW(s.last(), std::logic_error);
  EXPECT_THROW(s.add(standing(), -0.5), std::logic_error);
  s.add(standing(), 1.0);
  EXPECT_THROW(s.add(standing(), 0.0), std::logic_error);
  Random random(1);
  EXPECT_THROW(playKeys(skeleton(), s, kExact, random), std::logic_error);
}

TEST(Postures, RandomReachIsInReachAndOutsideTheTrunk) {
  Random random(3);
  bool high = false, low = false, back = false, across = false;
  for (int i = 0; i < 500; ++i) {
    const HandTarget hand = randomReach(random);
    const double distance = std::sqrt(hand.out * hand.out + hand.up * hand.up + hand.forward * hand.forward);
    EXPECT_LT(distance, 0.56);
    EXPECT_FALSE(hand.out < 0 && hand.out > -0.35 && std::abs(hand.forward) < 0.15 && hand.up < 0.05) << i;
    high |= hand.up > 0.4;
    low |= hand.up < -0.4;
    back |= hand.forward < -0.2;
    across |= hand.out < -0.2;
  }
  EXPECT_TRUE(high && low && back && across);
}

TEST(Postures, DisplaceTurnsTheFeetAboutThePelvis) {
  BodyFrame frame;
  frame.pelvis.x = 1.0;
  frame.left_foot.x = 1.1;
  displace(0.5, 0.0, 1.5707963, frame);
  EXPECT_NEAR(frame.pelvis.x, 1.5, 1e-9);
  EXPECT_NEAR(frame.left_foot.x, 1.5, 1e-6);
  EXPECT_NEAR(frame.left_foot.z, -0.1, 1e-6);
}

TEST(Postures, GuideHandFollowsItsPath) {
  BodyFrames frames(61);
  const HandTarget there{0.0, 0.1, 0.4, 0.0};
  guideHand(
      skeleton(), Side::Right, [&](double) { return there; }, 0.5, 0.0, frames);
  const Eigen::Vector3d wrist = wristOf(skeleton(), frames[30].right_arm);
  EXPECT_LT((wrist - Eigen::Vector3d(there.out, there.up, there.forward)).norm(), 0.02);
  EXPECT_EQ(frames[0].right_arm.elbow, 0.0);
  EXPECT_EQ(frames[30].left_arm.elbow, 0.0);
}

}  // namespace
}  // namespace depthmocap
