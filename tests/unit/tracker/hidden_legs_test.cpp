#include "libtracker/tracker/hidden_legs.h"

#include <numbers>

#include <gtest/gtest.h>

#include "libtracker/actor/make_actor.h"
#include "libtracker/tracker/alignment.h"

namespace depthmocap {
namespace {

constexpr double kTurn_rad = 0.7;

class HiddenLegsTest : public ::testing::Test {
 protected:
  // What is seen of this posture, turned and away from the origin, without the legs.
  MarkerSet seenAboveLegs(Pose q) {
    q[kRootTx] = 0.3;
    q[kRootTz] = -2;
    q[kRootRy] = kTurn_rad;
    truth_ = modelMarkers(actor_, q, fk_);
    floor_ = Eigen::Vector4d(0, 1, 0, -fk_.position({Bone::LeftFoot, actor_.skeleton.left_toe}).y());
    MarkerSet seen = truth_;
    for (int i = partIndex(Part::LeftUpperLeg); i <= partIndex(Part::RightLowerLeg); ++i) {
      seen.confidence[i] = 0;
      seen.position.col(i).setZero();
    }
    return seen;
  }
  // [m] Largest error of the leg's supposed markers.
  double worstOf(const MarkerSet& completed) const {
    double worst = 0;
    for (int i = partIndex(Part::LeftUpperLeg); i <= partIndex(Part::RightLowerLeg); ++i) {
      EXPECT_GT(completed.confidence[i], 0);
      EXPECT_LT(completed.confidence[i], 0.3);
      worst = std::max(worst, (completed.position.col(i) - truth_.position.col(i)).norm());
    }
    return worst;
  }

  Actor actor_ = averageActor(averageBoneLengths(1.75));
  ForwardKinematics fk_;
  MarkerSet truth_;
  Eigen::Vector4d floor_;
  HiddenLegs legs_;
};

Pose seated() {
  Pose q = Pose::Zero();
  q[kRfemurRx] = q[kLfemurRx] = -0.5 * std::numbers::pi;
  q[kRtibiaRx] = q[kLtibiaRx] = 0.5 * std::numbers::pi;
  return q;
}

TEST_F(HiddenLegsTest, StandBelowTheHipsWhereNothingElseIsKnown) {
  const MarkerSet seen = seenAboveLegs(Pose::Zero());
  legs_.look(true, std::nullopt);
  EXPECT_LT(worstOf(legs_.complete(seen, actor_)), 1e-6);
}

TEST_F(HiddenLegsTest, SitWhereTheFloorIsNear) {
  const MarkerSet seen = seenAboveLegs(seated());
  legs_.look(true, floor_);
  EXPECT_LT(worstOf(legs_.complete(seen, actor_)), 1e-6);
}

// The hem of a coat or a bag before the lap: little surface that the classifier takes for shins.
TEST_F(HiddenLegsTest, ALittleFarFromEitherPostureIsNoLeg) {
  MarkerSet seen = seenAboveLegs(Pose::Zero());
  const int shin = partIndex(Part::LeftLowerLeg);
  seen.position.col(shin) = seen.position.col(partIndex(Part::Torso));
  legs_.look(true, floor_);
  seen.confidence[shin] = 0.2;
  EXPECT_LT(worstOf(legs_.complete(seen, actor_)), 1e-6);
  seen.confidence[shin] = 0.8;
  EXPECT_EQ(legs_.complete(seen, actor_).confidence[shin], 0.8) << "plainly seen";
}

TEST_F(HiddenLegsTest, SitWhereTheThighsAreSeenLevel) {
  MarkerSet seen = seenAboveLegs(seated());
  for (const Part thigh : {Part::LeftUpperLeg, Part::RightUpperLeg}) {
    seen.confidence[partIndex(thigh)] = 0.8;
    seen.position.col(partIndex(thigh)) = truth_.position.col(partIndex(thigh));
  }
  legs_.look(true, std::nullopt);
  const MarkerSet& completed = legs_.complete(seen, actor_);
  EXPECT_EQ(completed.confidence[partIndex(Part::LeftUpperLeg)], 0.8);
  const int shin = partIndex(Part::LeftLowerLeg);
  EXPECT_LT((completed.position.col(shin) - truth_.position.col(shin)).norm(), 1e-6);
}

TEST_F(HiddenLegsTest, LegsInViewAreNeverSupposed) {
  const MarkerSet seen = seenAboveLegs(Pose::Zero());
  legs_.look(false, floor_);
  EXPECT_EQ(legs_.complete(seen, actor_).seenCount(), seen.seenCount());
}

TEST_F(HiddenLegsTest, NothingIsSupposedBelowAnArmAlone) {
  MarkerSet seen;
  seen.confidence[partIndex(Part::LeftLowerArm)] = 1;
  legs_.look(true, std::nullopt);
  EXPECT_EQ(legs_.complete(seen, actor_).seenCount(), 1);
}

}  // namespace
}  // namespace depthmocap
