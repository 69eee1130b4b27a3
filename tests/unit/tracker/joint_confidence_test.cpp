#include "libtracker/tracker/joint_confidence.h"

#include <cmath>

#include <gtest/gtest.h>

namespace depthmocap {
namespace {

double of(Joint joint, const MarkerSet& seen, const MarkerSet& solved) {
  return jointConfidence(seen, solved)[static_cast<int>(joint)];
}

TEST(JointConfidence, IsZeroWhereNothingWasSeen) {
  EXPECT_TRUE(jointConfidence({}, {}).isZero());
}

TEST(JointConfidence, ComesFromThePartsThatMeetAtTheJointAlone) {
  MarkerSet seen;
  seen.confidence[partIndex(Part::LeftLowerArm)] = 0.8;
  EXPECT_DOUBLE_EQ(of(Joint::LeftWrist, seen, {}), 0.8);
  EXPECT_DOUBLE_EQ(of(Joint::LeftElbow, seen, {}), 0.8);
  EXPECT_EQ(of(Joint::LeftShoulder, seen, {}), 0);
  EXPECT_EQ(of(Joint::RightWrist, seen, {}), 0);
  EXPECT_EQ((jointConfidence(seen, {}).array() > 0).count(), 2);
}

TEST(JointConfidence, FallsWithTheDistanceToTheSolvedPose) {
  MarkerSet seen;
  seen.confidence[partIndex(Part::Head)] = 1;
  MarkerSet solved;
  double last = of(Joint::Head, seen, solved);
  EXPECT_DOUBLE_EQ(last, 1);
  for (const double distance_m : {0.05, 0.1, 0.3}) {
    solved.position(0, partIndex(Part::Head)) = distance_m;
    const double confidence = of(Joint::Head, seen, solved);
    EXPECT_LT(confidence, last);
    last = confidence;
  }
  EXPECT_NEAR(last, std::exp(-3.0), 1e-12);
}

TEST(JointConfidence, TakesTheBestOfTheParts) {
  MarkerSet seen;
  seen.confidence[partIndex(Part::RightUpperLeg)] = 0.3;
  seen.confidence[partIndex(Part::RightLowerLeg)] = 0.6;
  EXPECT_DOUBLE_EQ(of(Joint::RightKnee, seen, {}), 0.6);
  EXPECT_DOUBLE_EQ(of(Joint::RightHip, seen, {}), 0.3);
  EXPECT_DOUBLE_EQ(of(Joint::RightToe, seen, {}), 0.6);
}

TEST(JointConfidence, EveryJointIsSeenWithAllParts) {
  MarkerSet seen;
  seen.confidence.setOnes();
  EXPECT_EQ(jointConfidence(seen, {}), (Eigen::Matrix<double, kJointCount, 1>::Ones()));
}

}  // namespace
}  // namespace depthmocap
