#include "libtracker/tracker/track_history.h"

#include <numbers>

#include <gtest/gtest.h>

#include "libtracker/skeleton/forward_kinematics.h"

namespace depthmocap {
namespace {

constexpr double kFrame_s = 1.0 / 30.0;
constexpr double kCoast_s = 0.5;

Pose poseAt(double x_m, double heading) {
  Pose q = Pose::Zero();
  q[kRootTx] = x_m;
  q[kRootRy] = heading;
  return q;
}

TEST(TrackHistory, StartsWithoutAPose) {
  TrackHistory history;
  EXPECT_EQ(history.state(), TrackState::Lost);
  EXPECT_FALSE(history.hasPose());
  history.miss(1.0, kCoast_s);
  EXPECT_EQ(history.state(), TrackState::Lost);
}

TEST(TrackHistory, PredictsConstantVelocityOverIrregularTimes) {
  TrackHistory history;
  history.accept(poseAt(0.0, 0.0), 1.0, true);
  EXPECT_TRUE(history.predicted(1.0 + kFrame_s).isApprox(poseAt(0.0, 0.0)));
  history.accept(poseAt(0.02, 0.0), 1.02, false);  // 1 m/s
  EXPECT_NEAR(history.predicted(1.05)[kRootTx], 0.05, 1e-12);
  EXPECT_NEAR(history.prev2(1.05)[kRootTx], -0.01, 1e-12);
  EXPECT_NEAR(history.predicted(9.0)[kRootTx], 0.12, 1e-12);   // not for longer than 0.1 s
  EXPECT_NEAR(history.predicted(1.02)[kRootTx], 0.02, 1e-12);  // no time, no change
}

TEST(TrackHistory, HeadingTurnsTheShortWay) {
  TrackHistory history;
  const double before = std::numbers::pi - 0.05;
  history.accept(poseAt(0, before), 1.0, true);
  history.accept(poseAt(0, before + 0.1 - 2 * std::numbers::pi), 1.0 + kFrame_s, false);
  EXPECT_NEAR(history.predicted(1.0 + 2 * kFrame_s)[kRootRy], before + 0.2 - 2 * std::numbers::pi, 1e-9);
}

TEST(TrackHistory, AFreshPoseHasNoVelocity) {
  TrackHistory history;
  history.accept(poseAt(0, 0), 1.0, true);
  history.accept(poseAt(1, 0), 1.0 + kFrame_s, true);
  EXPECT_EQ(history.predicted(1.1), poseAt(1, 0));
}

TEST(TrackHistory, CoastsAtRestAndThenLosesTheActor) {
  TrackHistory history;
  history.accept(poseAt(0, 0), 1.0, true);
  history.accept(poseAt(0.1, 0), 1.1, false);
  history.miss(1.2, kCoast_s);
  EXPECT_EQ(history.state(), TrackState::Coasting);
  EXPECT_TRUE(history.hasPose());
  EXPECT_EQ(history.predicted(1.3), poseAt(0.1, 0));
  history.miss(1.59, kCoast_s);
  EXPECT_EQ(history.state(), TrackState::Coasting);
  history.miss(1.61, kCoast_s);
  EXPECT_EQ(history.state(), TrackState::Lost);
  history.accept(poseAt(2, 0), 5.0, true);
  EXPECT_EQ(history.state(), TrackState::Tracking);
}

TEST(TrackHistory, TurnsThePoseWithTheWorld) {
  TrackHistory history;
  Pose q = poseAt(0.3, 0.7);
  q[kRootTz] = -2.5;
  q[kRootRx] = 0.2;
  history.accept(q, 1.0, true);
  Pose later = q;
  later[kRootTx] += 0.02;
  history.accept(later, 1.02, false);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.35, Eigen::Vector3d(1, 0.1, 0.2).normalized()).toRotationMatrix();
  history.turnWorld(turn);
  const Skeleton skeleton = makeSkeleton(BoneLengths{});
  const JointPositions expected = turn * jointPositions(skeleton, later);
  EXPECT_LT((jointPositions(skeleton, history.prev()) - expected).norm(), 1e-9);
  EXPECT_EQ(history.predicted(1.05), history.prev()) << "the velocity was of the world before";
}

}  // namespace
}  // namespace depthmocap
