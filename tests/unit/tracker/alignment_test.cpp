#include "libtracker/tracker/alignment.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "libtracker/actor/make_actor.h"
#include "libtracker/core/random.h"
#include "libtracker/skeleton/joint_limits.h"

namespace depthmocap {
namespace {

// Within the joint limits, anywhere in the room, any heading.
Pose somePose(Random& random) {
  Pose q = Pose::Zero();
  for (int i = kFirstBodyDof; i < kDofCount; ++i) q[i] = random.uniform(-1, 1);
  q = clampedToLimits(q);
  q.head<3>() << random.uniform(-2, 2), random.uniform(-1, 1), random.uniform(-4, -1);
  q[kRootRx] = random.uniform(-0.3, 0.3);
  q[kRootRy] = random.uniform(-3, 3);
  return q;
}

TEST(PlacedAt, FindsPlaceAndHeadingOfThePose) {
  const Actor actor = averageActor(averageBoneLengths(1.75));
  ForwardKinematics fk;
  Random random(2);
  for (int i = 0; i < 50; ++i) {
    const Pose truth = somePose(random);
    const MarkerSet seen = modelMarkers(actor, truth, fk);
    Pose elsewhere = truth;
    elsewhere.head<3>() << 9, 9, 9;
    elsewhere[kRootRy] = 1;
    EXPECT_LT((placedAt(actor, elsewhere, seen, fk) - truth).cwiseAbs().maxCoeff(), 1e-9);
  }
}

TEST(PlacedAt, DoesNotReadMarkersThatWereNotSeen) {
  const Actor actor = averageActor(averageBoneLengths(1.75));
  ForwardKinematics fk;
  Random random(3);
  const Pose truth = somePose(random);
  MarkerSet seen = modelMarkers(actor, truth, fk);
  for (int i = 5; i < 12; ++i) {
    seen.position.col(i).setConstant(100);
    seen.confidence[i] = 0;
  }
  EXPECT_LT((placedAt(actor, truth, seen, fk) - truth).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(PlacedAt, MovesNothingElseAndIsFiniteWithoutMarkers) {
  const Actor actor = averageActor(averageBoneLengths(1.75));
  ForwardKinematics fk;
  Random random(4);
  const Pose q = somePose(random);
  const Pose placed = placedAt(actor, q, MarkerSet{}, fk);
  EXPECT_TRUE(placed.allFinite());
  EXPECT_EQ(placed.tail<kDofCount - kFirstBodyDof>(), q.tail<kDofCount - kFirstBodyDof>());
}

TEST(ModelMarkers, HeadIsAboveTorsoAndLeftIsLeft) {
  ForwardKinematics fk;
  const MarkerSet markers = modelMarkers(averageActor(averageBoneLengths(1.75)), Pose::Zero(), fk);
  const auto at = [&](Part part) { return Eigen::Vector3d(markers.position.col(partIndex(part))); };
  EXPECT_GT(at(Part::Head).y(), at(Part::Torso).y() + 0.2);
  EXPECT_GT(at(Part::LeftLowerArm).x(), at(Part::RightLowerArm).x() + 1.0);
  EXPECT_EQ(markers.seenCount(), kPartCount);
}

TEST(Rotated, TurnsPositionsAndKeepsConfidence) {
  MarkerSet markers;
  markers.position.col(3) = Eigen::Vector3d(1, 2, 3);
  markers.confidence[3] = 0.5;
  const Eigen::Matrix3d quarter = Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const MarkerSet turned = rotated(quarter, markers);
  EXPECT_LT((turned.position.col(3) - Eigen::Vector3d(-2, 1, 3)).norm(), 1e-12);
  EXPECT_EQ(turned.confidence, markers.confidence);
}

}  // namespace
}  // namespace depthmocap
