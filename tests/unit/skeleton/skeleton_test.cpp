#include "libtracker/skeleton/skeleton.h"

#include <gtest/gtest.h>

#include "libtracker/skeleton/forward_kinematics.h"
#include "libtracker/skeleton/marker_model.h"

namespace depthmocap {
namespace {

TEST(BoneLengths, AverageBodyHasTheStatureAskedFor) {
  for (const double stature : {1.2, 1.62, 1.75, 2.1}) {
    EXPECT_NEAR(statureOf(averageBoneLengths(stature)), stature, 1e-12);
  }
}

TEST(BoneLengths, DefaultStatureIsAsDocumented) {
  EXPECT_NEAR(statureOf(BoneLengths{}), 1.77, 0.005);
}

TEST(BoneLengths, NamesAndFieldsAgreeInNumberAndScale) {
  const BoneLengths lengths;
  const BoneLengths twice = lengths.scaled(2.0);
  for (auto field : kBoneLengthFields) EXPECT_DOUBLE_EQ(twice.*field, 2.0 * (lengths.*field));
  EXPECT_EQ(sizeof(BoneLengths), kBoneLengthCount * sizeof(double));
}

TEST(Skeleton, BonesHaveTheLengthsGiven) {
  const BoneLengths l = averageBoneLengths(1.6);
  const JointPositions p = jointPositions(makeSkeleton(l), Pose::Zero());
  const auto distance = [&](Joint a, Joint b) {
    return (p.col(static_cast<int>(a)) - p.col(static_cast<int>(b))).norm();
  };
  EXPECT_NEAR(distance(Joint::LeftShoulder, Joint::LeftElbow), l.upper_arm, 1e-12);
  EXPECT_NEAR(distance(Joint::RightElbow, Joint::RightWrist), l.lower_arm, 1e-12);
  EXPECT_NEAR(distance(Joint::LeftShoulder, Joint::RightShoulder), l.shoulder_width, 1e-12);
  EXPECT_NEAR(distance(Joint::LeftHip, Joint::RightHip), l.hip_width, 1e-12);
  EXPECT_NEAR(distance(Joint::LeftHip, Joint::LeftKnee), l.upper_leg, 1e-12);
  EXPECT_NEAR(distance(Joint::RightKnee, Joint::RightAnkle), l.lower_leg, 1e-12);
  EXPECT_NEAR(distance(Joint::RightAnkle, Joint::RightToe), l.foot, 1e-12);
  EXPECT_NEAR(distance(Joint::Pelvis, Joint::Neck), l.torso, 1e-12);
  EXPECT_NEAR(distance(Joint::Pelvis, Joint::Spine), l.spine, 1e-12);
}

TEST(MarkerModel, MirrorsAndScalesWithTheBody) {
  const BoneLengths lengths;
  const MarkerModel model = averageMarkerModel(makeSkeleton(lengths));
  const MarkerModel big = averageMarkerModel(makeSkeleton(lengths.scaled(1.25)));
  for (int i = 0; i < kPartCount; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const auto other = static_cast<std::size_t>(partIndex(mirrored(partAt(i))));
    const Eigen::Vector3d mirror(-model[other].p_bone.x(), model[other].p_bone.y(), model[other].p_bone.z());
    EXPECT_LT((model[at].p_bone - mirror).norm(), 1e-12) << kPartNames[at + 1];
    EXPECT_LT((1.25 * model[at].p_bone - big[at].p_bone).norm(), 1e-12) << kPartNames[at + 1];
  }
}

}  // namespace
}  // namespace depthmocap
