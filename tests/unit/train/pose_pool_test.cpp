#include "forest/train/pose_pool.h"

#include <gtest/gtest.h>

#include "libtracker/skeleton/joint_limits.h"

namespace depthmocap {
namespace {

PoseDatabase twoMotions() {
  PoseDatabase database;
  database.origin = "a test";
  for (int i = 0; i < 20; ++i) {
    auto& q = database.poses.emplace_back(PosePool::StoredPose::Zero());
    q[kRtibiaRx] = static_cast<float>(i < 10 ? 0.03 * i : 1.0);
    q[kRootRy] = 2.0F;
  }
  database.sources = {{"16_15", 0, 10}, {"16_16", 10, 10}};
  return database;
}

TEST(PosePool, HoldsOutTheNamedMotions) {
  const HeldOutMotions held_out({"16_15"});
  PosePool train, validate;
  addPoses(twoMotions(), held_out, PoseUse::Train, 0.0, train);
  addPoses(twoMotions(), held_out, PoseUse::Validate, 0.0, validate);
  ASSERT_EQ(train.poses.size(), 10U);
  ASSERT_EQ(validate.poses.size(), 10U);
  for (const auto& q : train.poses) EXPECT_EQ(q[kRtibiaRx], 1.0F);
  for (const auto& q : validate.poses) EXPECT_LT(q[kRtibiaRx], 0.5F);
  EXPECT_NE(train.description, validate.description + "x");
}

TEST(PosePool, AMotionsMirrorImageGoesWithIt) {
  EXPECT_TRUE(HeldOutMotions({"16_15"}).contains("16_15:mirrored"));
  EXPECT_FALSE(HeldOutMotions({"16_1"}).contains("16_15:mirrored"));
  for (int i = 0; i < 100; ++i) {
    const std::string name = "motion_" + std::to_string(i);
    EXPECT_EQ(HeldOutMotions().contains(name), HeldOutMotions().contains(name + ":mirrored"));
  }
}

TEST(PosePool, WithoutNamesATenthIsHeldOut) {
  const HeldOutMotions held_out;
  int out = 0;
  for (int i = 0; i < 1000; ++i) out += held_out.contains("motion_" + std::to_string(i)) ? 1 : 0;
  EXPECT_NEAR(out, 100, 40);
}

TEST(PosePool, NearDuplicatesAndPlaceAreDropped) {
  PosePool pool;
  addPoses(twoMotions(), HeldOutMotions({"none"}), PoseUse::Train, 0.1, pool);
  // 0, 0.12, 0.24 of the slow motion (0.03 a frame), and one of the still one.
  EXPECT_EQ(pool.poses.size(), 4U);
  for (const auto& q : pool.poses) EXPECT_EQ(q[kRootRy], 0.0F);
}

TEST(PosePool, DrawnPosesKeepTheLimitsAndMixArms) {
  PosePool pool;
  addPoses(twoMotions(), HeldOutMotions({"none"}), PoseUse::Train, 0.0, pool);
  for (auto& q : pool.poses) q[kRradiusRy] = q[kRtibiaRx];
  Random random(1);
  int mixed = 0;
  for (int i = 0; i < 200; ++i) {
    const Pose q = drawPose(pool, {.mix_share = 0.5, .jitter = 0.0}, random);
    EXPECT_EQ(q, clampedToLimits(q));
    mixed += std::abs(q[kRradiusRy] - q[kRtibiaRx]) > 0.01 ? 1 : 0;
    const Pose jittered = drawPose(pool, {.mix_share = 0.0, .jitter = 2.0}, random);
    EXPECT_EQ(jittered, clampedToLimits(jittered));
  }
  EXPECT_GT(mixed, 40);
  EXPECT_LT(mixed, 110);
}

// 19 poses of a walker who hardly moves and one who bends down.
TEST(PosePool, ByPostureRarePosesAreAsFrequentAsCommonOnes) {
  PosePool pool;
  for (int i = 0; i < 19; ++i) {
    PosePool::StoredPose q = PosePool::StoredPose::Zero();
    q[kRtibiaRx] = static_cast<float>(0.01 * i);
    q[kRhumerusRz] = static_cast<float>(0.05 * i);  // arms make no posture
    pool.add(q);
  }
  PosePool::StoredPose bent = PosePool::StoredPose::Zero();
  bent[kRootRx] = 1.2F;
  pool.add(bent);
  ASSERT_EQ(pool.by_posture.size(), 2U);
  for (const double share : {0.0, 1.0}) {
    Random random(3);
    int found = 0;
    for (int i = 0; i < 1000; ++i) {
      const Pose q = drawPose(pool, {.mix_share = 0, .hang_share = 0, .jitter = 0, .posture_share = share}, random);
      found += q[kRootRx] > 1.0 ? 1 : 0;
    }
    EXPECT_NEAR(found, share > 0 ? 500 : 50, 60) << share;
  }
}

TEST(PosePool, TPosesAreNearTheZeroPose) {
  Random random(2);
  double bent = 0;
  for (int i = 0; i < 500; ++i) {
    const Pose q = drawTPose(random);
    EXPECT_EQ(q, clampedToLimits(q));
    EXPECT_LT(std::abs(q[kRhumerusRz]), 0.6);
    EXPECT_GE(q[kRradiusRy], 0);
    EXPECT_LE(q[kLradiusRy], 0);
    bent += q[kRradiusRy];
  }
  EXPECT_GT(bent / 500, 0.05);
}

}  // namespace
}  // namespace depthmocap
