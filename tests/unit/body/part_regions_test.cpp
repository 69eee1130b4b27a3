#include "libtracker/body/part_regions.h"

#include <array>

#include <gtest/gtest.h>

#include "libtracker/body/builtin_body.h"
#include "libtracker/skeleton/forward_kinematics.h"

namespace depthmocap {
namespace {

Part partAtJoint(const Skeleton& skeleton, Joint joint, double dx = 0, double dy = 0) {
  const JointPositions joints = jointPositions(skeleton, Pose::Zero());
  return partOfPoint(skeleton, (joints.col(static_cast<int>(joint)) + Eigen::Vector3d(dx, dy, 0)).cast<float>());
}

TEST(PartRegions, HoldTheJointsOfTheirNames) {
  const Skeleton s = makeSkeleton(averageBoneLengths(1.75));
  EXPECT_EQ(partAtJoint(s, Joint::Head), Part::Head);
  EXPECT_EQ(partAtJoint(s, Joint::Neck), Part::Neck);
  EXPECT_EQ(partAtJoint(s, Joint::Spine), Part::Torso);
  EXPECT_EQ(partAtJoint(s, Joint::LeftShoulder), Part::LeftShoulder);
  EXPECT_EQ(partAtJoint(s, Joint::RightShoulder), Part::RightShoulder);
  EXPECT_EQ(partAtJoint(s, Joint::LeftElbow, -0.01), Part::LeftUpperArm);
  EXPECT_EQ(partAtJoint(s, Joint::LeftElbow, 0.01), Part::LeftLowerArm);
  EXPECT_EQ(partAtJoint(s, Joint::RightWrist), Part::RightLowerArm);
  EXPECT_EQ(partAtJoint(s, Joint::LeftHip), Part::LeftWaist);
  EXPECT_EQ(partAtJoint(s, Joint::RightHip), Part::RightWaist);
  EXPECT_EQ(partAtJoint(s, Joint::LeftKnee, 0, 0.01), Part::LeftUpperLeg);
  EXPECT_EQ(partAtJoint(s, Joint::RightKnee, 0, -0.01), Part::RightLowerLeg);
  EXPECT_EQ(partAtJoint(s, Joint::RightToe), Part::RightLowerLeg);
}

TEST(PartRegions, AllFifteenOccurEquallyOnBothSides) {
  for (const BodyShape& shape : {BodyShape{Sex::Male, 1.8, 75}, BodyShape{Sex::Female, 1.55, 85}}) {
    const BodySurface body = makeBuiltinBody(shape);
    ASSERT_EQ(body.part.size(), body.triangles.size());
    std::array<double, kPartCount + 1> area{};
    for (std::size_t i = 0; i < body.triangles.size(); ++i) {
      const auto& t = body.triangles[i];
      const Eigen::Vector3f a = body.vertices[t[1]] - body.vertices[t[0]];
      area[body.part[i]] += 0.5 * static_cast<double>(a.cross(body.vertices[t[2]] - body.vertices[t[0]]).norm());
    }
    EXPECT_EQ(area[0], 0);
    for (int n = 1; n <= kPartCount; ++n) {
      const auto part = static_cast<Part>(n);
      const double here = area[static_cast<std::size_t>(n)];
      EXPECT_GT(here, 0.015) << kPartNames[static_cast<std::size_t>(n)];  // [m^2]
      EXPECT_NEAR(area[static_cast<std::size_t>(mirrored(part))], here, 0.05 * here);
    }
  }
}

TEST(PartRegions, MirrorPointsHaveMirroredParts) {
  const Skeleton s = makeSkeleton(averageBoneLengths(1.6));
  for (float y = -0.9F; y < 0.8F; y += 0.05F) {
    for (float x = 0.01F; x < 0.7F; x += 0.04F) {
      EXPECT_EQ(partOfPoint(s, {-x, y, 0.05F}), mirrored(partOfPoint(s, {x, y, 0.05F})));
    }
  }
}

}  // namespace
}  // namespace depthmocap
