#include "libtracker/segment/expected_body.h"

#include <limits>

#include <gtest/gtest.h>

namespace depthmocap {
namespace {

// Somebody in a T-pose, 2.5 m away.
JointPositions joints() {
  JointPositions p;
  p.row(0) << 0, 0, 0, 0, 0.18, 0.45, 0.70, -0.18, -0.45, -0.70, 0.09, 0.09, 0.09, 0.09, -0.09, -0.09, -0.09, -0.09;
  p.row(1) << 0, -0.2, -0.5, -0.65, -0.45, -0.45, -0.45, -0.45, -0.45, -0.45, 0.03, 0.45, 0.85, 0.92, 0.03, 0.45, 0.85,
      0.92;
  p.row(2).setConstant(2.5);
  return p;
}

Eigen::Vector3f at(Joint joint) {
  return joints().col(static_cast<int>(joint)).cast<float>();
}

TEST(ExpectedBody, ExplainsWhatIsNearItsLines) {
  const ExpectedBody body(1, joints());
  for (int i = 0; i < kJointCount; ++i) {
    const Eigen::Vector3f joint = joints().col(i).cast<float>();
    EXPECT_TRUE(body.explains(joint + Eigen::Vector3f(0, 0, 0.10F))) << kJointNames[static_cast<std::size_t>(i)];
    EXPECT_NEAR(body.distance(joint), 0, 1e-5);
  }
  EXPECT_FALSE(body.explains(at(Joint::LeftKnee) + Eigen::Vector3f(0, 0, 0.16F))) << "a seat behind the shin";
  EXPECT_TRUE(body.explains(at(Joint::Spine) + Eigen::Vector3f(0, 0, -0.16F))) << "a belly";
  EXPECT_FALSE(body.explains(at(Joint::Spine) + Eigen::Vector3f(0, 0, -0.25F)));
}

TEST(ExpectedBody, IsFarFromWhatIsBeyondItsReach) {
  EXPECT_EQ(ExpectedBody(1, joints()).distance({3, 0, 0}), std::numeric_limits<float>::max());
}

}  // namespace
}  // namespace depthmocap
