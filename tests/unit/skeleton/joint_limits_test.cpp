#include "libtracker/skeleton/joint_limits.h"

#include <gtest/gtest.h>

#include "libtracker/skeleton/forward_kinematics.h"

namespace depthmocap {
namespace {

TEST(JointLimits, LeftIsTheMirrorOfRight) {
  const JointLimits& limits = jointLimits();
  const Pose a = mirroredPose(limits.lower);
  const Pose b = mirroredPose(limits.upper);
  for (int i = kFirstBodyDof; i < kDofCount; ++i) {
    EXPECT_DOUBLE_EQ(limits.lower[i], std::min(a[i], b[i])) << kDofNames[static_cast<std::size_t>(i)];
    EXPECT_DOUBLE_EQ(limits.upper[i], std::max(a[i], b[i])) << kDofNames[static_cast<std::size_t>(i)];
  }
}

TEST(JointLimits, EveryBodyDofIsLimitedAroundZeroAndTheRootIsFree) {
  const JointLimits& limits = jointLimits();
  for (int i = 0; i < kDofCount; ++i) {
    EXPECT_LT(limits.lower[i], 0) << kDofNames[static_cast<std::size_t>(i)];
    EXPECT_GT(limits.upper[i], 0) << kDofNames[static_cast<std::size_t>(i)];
    EXPECT_EQ(limits.upper[i] < 4.0, i >= kFirstBodyDof) << kDofNames[static_cast<std::size_t>(i)];
  }
}

TEST(JointLimits, ElbowsAndKneesBendOneWay) {
  const JointLimits& limits = jointLimits();
  EXPECT_GT(limits.upper[kRradiusRy], 2.0);
  EXPECT_GT(limits.lower[kRradiusRy], -0.2);
  EXPECT_LT(limits.lower[kLradiusRy], -2.0);
  EXPECT_LT(limits.upper[kLradiusRy], 0.2);
  EXPECT_GT(limits.lower[kLtibiaRx], -0.2);
}

TEST(JointLimits, ClampingMovesOnlyWhatIsOutside) {
  Pose q = Pose::Zero();
  q[kRootTx] = 50;
  q[kRootRy] = 9;
  q[kLtibiaRx] = -1;
  const Pose clamped = clampedToLimits(q);
  EXPECT_DOUBLE_EQ(clamped[kLtibiaRx], jointLimits().lower[kLtibiaRx]);
  q[kLtibiaRx] = clamped[kLtibiaRx];
  EXPECT_EQ(clamped, q);
}

}  // namespace
}  // namespace depthmocap
