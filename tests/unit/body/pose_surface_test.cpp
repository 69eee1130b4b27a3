#include "libtracker/body/pose_surface.h"

#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "libtracker/body/builtin_body.h"
#include "libtracker/skeleton/forward_kinematics.h"

namespace depthmocap {
namespace {

const BodySurface& body() {
  static const BodySurface surface = makeBuiltinBody({Sex::Male, 1.8, 78});
  return surface;
}

double volumeIn(const Pose& q) {
  std::vector<Eigen::Vector3f> posed;
  poseSurface(body(), q, posed);
  return enclosedVolume(posed, body().triangles);
}

TEST(PoseSurface, ZeroPoseIsTheRestShape) {
  std::vector<Eigen::Vector3f> posed;
  poseSurface(body(), Pose::Zero(), posed);
  ASSERT_EQ(posed.size(), body().vertices.size());
  for (std::size_t i = 0; i < posed.size(); ++i) EXPECT_LT((posed[i] - body().vertices[i]).norm(), 1e-5F);
}

TEST(PoseSurface, WeightsSumToOneAndNameRealBones) {
  for (const auto& skin : body().skin) {
    EXPECT_NEAR(std::accumulate(skin.weight.begin(), skin.weight.end(), 0.0F), 1.0F, 1e-5F);
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_GE(skin.weight[i], 0.0F);
      EXPECT_LT(skin.bone[i], kSkinBoneCount);
      EXPECT_LE(skin.weight[i], skin.weight[i == 0 ? 0 : i - 1]);
    }
  }
}

TEST(PoseSurface, RootMovesTheWholeBodyRigidly) {
  Pose q = Pose::Zero();
  q[kRootTx] = 0.3;
  q[kRootTz] = -2.0;
  q[kRootRy] = 1.1;
  std::vector<Eigen::Vector3f> posed;
  poseSurface(body(), q, posed);
  const Eigen::Matrix3f R = Eigen::AngleAxisf(1.1F, Eigen::Vector3f::UnitY()).toRotationMatrix();
  for (std::size_t i = 0; i < posed.size(); i += 7) {
    EXPECT_LT((posed[i] - (R * body().vertices[i] + Eigen::Vector3f(0.3F, 0, -2.0F))).norm(), 1e-5F);
  }
}

TEST(PoseSurface, HandAndFootFollowTheirBones) {
  Pose q = Pose::Zero();
  q[kLhumerusRz] = -1.2;
  q[kLhumerusRx] = 0.9;
  q[kLradiusRy] = -1.0;
  q[kRfemurRx] = -1.4;
  q[kRfemurRy] = 0.4;
  q[kRtibiaRx] = 1.5;
  const JointPositions joints = jointPositions(body().skeleton, q);
  const JointPositions rest = jointPositions(body().skeleton, Pose::Zero());
  std::vector<Eigen::Vector3f> posed;
  poseSurface(body(), q, posed);
  // The distance of the skin from the joint that carries it does not change.
  const auto distance_change = [&](Joint joint, auto&& chosen) {
    float worst = 0;
    for (std::size_t i = 0; i < posed.size(); ++i) {
      if (!chosen(body().vertices[i])) continue;
      const auto j = static_cast<int>(joint);
      const float before = (body().vertices[i] - rest.col(j).cast<float>()).norm();
      worst = std::max(worst, std::abs((posed[i] - joints.col(j).cast<float>()).norm() - before));
    }
    return worst;
  };
  const auto wrist_x = static_cast<float>(rest(0, static_cast<int>(Joint::LeftWrist)));
  EXPECT_LT(distance_change(Joint::LeftWrist, [&](const auto& v) { return v.x() > wrist_x; }), 1e-4F);
  const auto toe_z = static_cast<float>(rest(2, static_cast<int>(Joint::RightToe)));
  EXPECT_LT(
      distance_change(Joint::RightToe, [&](const auto& v) { return v.x() < 0 && v.z() > toe_z && v.y() < -0.7F; }),
      1e-4F);
}

TEST(PoseSurface, LegsAndArmsDoNotDragOtherLimbs) {
  Pose q = Pose::Zero();
  q[kLfemurRx] = -1.5;
  q[kLhumerusRz] = -1.3;
  std::vector<Eigen::Vector3f> posed;
  poseSurface(body(), q, posed);
  const BoneLengths& l = body().skeleton.lengths;
  for (std::size_t i = 0; i < posed.size(); ++i) {
    const Eigen::Vector3f& v = body().vertices[i];
    const bool right_leg = v.x() < 0 && v.y() < static_cast<float>(-l.hip_drop - 0.25 * l.upper_leg);
    const bool flank = v.y() < static_cast<float>(l.torso - l.shoulder_drop - 0.5 * l.upper_arm) && v.y() > 0.1F;
    const bool right_arm = v.x() < -0.3F;
    if (right_leg || flank || right_arm) {
      EXPECT_LT((posed[i] - v).norm(), 1e-5F);
    }
  }
}

// Linear blending loses volume at bent joints; wrong weights lose much more.
TEST(PoseSurface, KeepsTheVolumeInCommonPoses) {
  const double rest = volumeIn(Pose::Zero());
  Pose down = Pose::Zero();
  down[kLhumerusRz] = -1.25;
  down[kRhumerusRz] = 1.25;
  EXPECT_NEAR(volumeIn(down), rest, 0.03 * rest);
  Pose up = Pose::Zero();
  up[kLhumerusRz] = 1.1;
  up[kRhumerusRz] = -1.1;
  EXPECT_NEAR(volumeIn(up), rest, 0.03 * rest);
  Pose sit = down;
  for (const Dof dof : {kLfemurRx, kRfemurRx}) sit[dof] = -1.5;
  for (const Dof dof : {kLtibiaRx, kRtibiaRx}) sit[dof] = 1.5;
  EXPECT_NEAR(volumeIn(sit), rest, 0.08 * rest);
}

}  // namespace
}  // namespace depthmocap
