#include "forest/render/staging.h"

#include <numbers>

#include <gtest/gtest.h>

#include "depthmocap/error.h"
#include "libtracker/body/builtin_body.h"
#include "libtracker/body/pose_surface.h"
#include "libtracker/skeleton/forward_kinematics.h"

namespace depthmocap {
namespace {

const BodySurface& smallWoman() {
  static const BodySurface surface = makeBuiltinBody({.sex = Sex::Female, .stature_m = 1.60, .weight_kg = 55});
  return surface;
}

// Walks 2 m along +x while facing +x, and jumps 0.3 m in the middle.
MotionClip walkAndJump() {
  MotionClip clip;
  clip.name = "test";
  for (int i = 0; i < 41; ++i) {
    Pose q = Pose::Zero();
    q[kRootTx] = 5.0 + 0.05 * i;
    q[kRootTy] = 0.94 + (i == 20 ? 0.3 : 0.0);
    q[kRootTz] = 3.0;
    q[kRootRy] = std::numbers::pi / 2;
    clip.poses.push_back(q);
  }
  return clip;
}

float lowestVertex(const BodySurface& body, const Pose& q) {
  std::vector<Eigen::Vector3f> vertices;
  poseSurface(body, q, vertices);
  float lowest = vertices.front().y();
  for (const Eigen::Vector3f& v : vertices) lowest = std::min(lowest, v.y());
  return lowest;
}

TEST(Staging, FirstFrameFacesTheCameraAndTheActorComesCloser) {
  const StagedMotion staged = stageMotion(walkAndJump(), smallWoman(), {});
  EXPECT_NEAR(staged.poses.front()[kRootRy], 0.0, 1e-12);
  EXPECT_LT(staged.poses.front()[kRootTz], staged.poses.back()[kRootTz]);
  EXPECT_NEAR(staged.poses.front()[kRootTx], staged.poses.back()[kRootTx], 1e-9);
}

TEST(Staging, YawTurnsTheActorAndThePathWithHim) {
  const double yaw = std::numbers::pi / 2;
  const StagedMotion staged = stageMotion(walkAndJump(), smallWoman(), {.yaw = yaw});
  EXPECT_NEAR(staged.poses.front()[kRootRy], yaw, 1e-12);
  EXPECT_GT(staged.poses.back()[kRootTx] - staged.poses.front()[kRootTx], 1.0);
}

TEST(Staging, MiddleOfThePathIsOnTheAxisAtTheDistance) {
  for (const double yaw : {0.0, 0.7, 2.0}) {
    const StagedMotion staged = stageMotion(walkAndJump(), smallWoman(), {.yaw = yaw, .distance_m = 3.1});
    const Pose middle = 0.5 * (staged.poses.front() + staged.poses.back());
    EXPECT_NEAR(middle[kRootTx], 0.0, 1e-9);
    EXPECT_NEAR(middle[kRootTz], -3.1, 1e-9);
  }
}

TEST(Staging, AnApproachEndsBeforeTheCamera) {
  const StagingConfig config{.distance_m = 2.0};
  const StagedMotion staged = stageMotion(walkAndJump(), smallWoman(), config);
  EXPECT_NEAR(-staged.poses.back()[kRootTz], config.min_distance_m, 1e-9);
  EXPECT_EQ(staged.path_scale, 1.0);
}

TEST(Staging, APathAcrossIsMovedBackIntoView) {
  const StagingConfig config{.yaw = std::numbers::pi / 2, .distance_m = 2.0};
  const StagedMotion staged = stageMotion(walkAndJump(), smallWoman(), config);
  for (const Pose& q : staged.poses) EXPECT_LT(std::abs(q[kRootTx] / q[kRootTz]), config.half_view);
  EXPECT_EQ(staged.path_scale, 1.0);
}

TEST(Staging, APathTooLongForTheRangeIsShortened) {
  const StagingConfig config{.distance_m = 2.0, .max_distance_m = 2.6};
  const StagedMotion staged = stageMotion(walkAndJump(), smallWoman(), config);
  EXPECT_LT(staged.path_scale, 0.7);
  EXPECT_GT(staged.path_scale, 0.3);
  EXPECT_GE(-staged.poses.back()[kRootTz], config.min_distance_m - 1e-9);
  EXPECT_LE(-staged.poses.front()[kRootTz], config.max_distance_m + 1e-9);
}

TEST(Staging, FeetStandOnTheFloorAndJumpAboveIt) {
  const StagedMotion staged = stageMotion(walkAndJump(), smallWoman(), {.camera_height_m = 1.2});
  EXPECT_DOUBLE_EQ(staged.floor_y, -1.2);
  EXPECT_NEAR(lowestVertex(smallWoman(), staged.poses[3]), -1.2, 0.01);
  const BoneLengths performer;
  const BoneLengths& lengths = smallWoman().skeleton.lengths;
  const double ratio = (lengths.upper_leg + lengths.lower_leg) / (performer.upper_leg + performer.lower_leg);
  EXPECT_NEAR(lowestVertex(smallWoman(), staged.poses[20]), -1.2 + 0.3 * ratio, 0.01);
}

TEST(Staging, ABendKneeMovesTheBodyNotTheFloor) {
  MotionClip clip = walkAndJump();
  for (Pose& q : clip.poses) {
    q[kRootTy] = 0.8;
    q[kRfemurRx] = q[kLfemurRx] = -0.6;
    q[kRtibiaRx] = q[kLtibiaRx] = 1.2;
    q[kRfootRx] = q[kLfootRx] = -0.6;
  }
  const StagedMotion staged = stageMotion(clip, smallWoman(), {});
  for (const Pose& q : staged.poses) EXPECT_NEAR(lowestVertex(smallWoman(), q), staged.floor_y, 0.02);
}

TEST(Staging, JointAnglesAreKept) {
  MotionClip clip = walkAndJump();
  clip.poses[7][kRradiusRy] = 1.1;
  const StagedMotion staged = stageMotion(clip, smallWoman(), {.yaw = 0.3});
  EXPECT_EQ(staged.poses[7].tail(kDofCount - kFirstBodyDof), clip.poses[7].tail(kDofCount - kFirstBodyDof));
}

TEST(Staging, BadSettingsAreErrors) {
  EXPECT_THROW(stageMotion({}, smallWoman(), {}), Error);
  EXPECT_THROW(stageMotion(walkAndJump(), smallWoman(), {.distance_m = 0.0}), Error);
  EXPECT_THROW(stageMotion(walkAndJump(), smallWoman(), {.camera_height_m = -1.0}), Error);
}

}  // namespace
}  // namespace depthmocap
