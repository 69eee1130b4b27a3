#include "libtracker/posedb_build/build_pose_database.h"

#include <cmath>

#include <gtest/gtest.h>

#include "depthmocap/error.h"
#include "libtracker/core/random.h"
#include "libtracker/skeleton/forward_kinematics.h"
#include "libtracker/skeleton/joint_limits.h"

namespace depthmocap {
namespace {

// An arm and a leg that swing: near-duplicates lie along it, and it comes back to where it was.
MotionClip swingingClip(const std::string& name, double heading) {
  MotionClip clip;
  clip.name = name;
  for (int i = 0; i < 200; ++i) {
    Pose q = Pose::Zero();
    q.head<3>() << 0.01 * i, 0.9, -0.3;
    q[kRootRy] = heading;
    q[kLhumerusRz] = std::sin(0.05 * i);
    q[kRfemurRx] = -0.5 * std::sin(0.05 * i);
    q[kLradiusRy] = -0.4;
    clip.poses.push_back(q);
  }
  return clip;
}

double jointDistance(const Pose& a, const Pose& b) {
  const Skeleton skeleton = makeSkeleton(BoneLengths{});
  return (jointPositions(skeleton, a) - jointPositions(skeleton, b)).colwise().norm().maxCoeff();
}

TEST(BuildPoseDatabase, KeptPosesDifferAndCoverAllOthers) {
  PoseDatabaseConfig config;
  config.mirror = false;
  const MotionClip clip = swingingClip("swing", 0.7);
  const PoseDatabaseResult result = buildPoseDatabase({clip}, config);
  const PoseDatabase& database = result.database;
  EXPECT_EQ(result.counts.frames, clip.poses.size());
  EXPECT_EQ(result.counts.kept, database.size());
  EXPECT_LT(database.size(), clip.poses.size());
  constexpr double kRounding = 1e-5;
  for (std::size_t i = 0; i < database.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_GT(jointDistance(database.pose(i), database.pose(j)), config.threshold_m - kRounding);
    }
  }
  for (Pose q : clip.poses) {
    q[kRootTx] = q[kRootTy] = q[kRootTz] = q[kRootRy] = 0;
    double nearest = 1e9;
    for (std::size_t i = 0; i < database.size(); ++i) nearest = std::min(nearest, jointDistance(q, database.pose(i)));
    EXPECT_LT(nearest, config.threshold_m + kRounding);
  }
}

TEST(BuildPoseDatabase, PlaceAndHeadingAreRemoved) {
  PoseDatabaseConfig config;
  config.mirror = false;
  const PoseDatabase one = buildPoseDatabase({swingingClip("a", 0)}, config).database;
  const PoseDatabaseResult both = buildPoseDatabase({swingingClip("a", 0), swingingClip("b", 2.5)}, config);
  for (const auto& pose : one.poses) {
    for (const Dof dof : {kRootTx, kRootTy, kRootTz, kRootRy}) EXPECT_EQ(pose[dof], 0.0F);
  }
  // The same motion in another direction brings nothing new, but its source is still told.
  EXPECT_EQ(both.database.size(), one.size());
  ASSERT_EQ(both.database.sources.size(), 2U);
  EXPECT_EQ(both.database.sources[1].name, "b");
  EXPECT_EQ(both.database.sources[1].count, 0U);
}

TEST(BuildPoseDatabase, MirrorImagesAreSourcesOfTheirOwn) {
  const PoseDatabase database = buildPoseDatabase({swingingClip("swing", 0)}, {}).database;
  ASSERT_EQ(database.sources.size(), 2U);
  EXPECT_EQ(database.sources[1].name, "swing:mirrored");
  EXPECT_EQ(database.sources[1].first, database.sources[0].count);
  EXPECT_EQ(database.sources[0].count + database.sources[1].count, database.size());
  // Some pose with the right arm down, where the motion has only the left arm down.
  double lowest = 1e9;
  for (const auto& pose : database.poses) lowest = std::min<double>(lowest, -pose[kRhumerusRz]);
  EXPECT_LT(lowest, -0.9);
}

TEST(BuildPoseDatabase, ErrorsOfCaptureAreLeftOut) {
  MotionClip clip = swingingClip("swing", 0);
  clip.poses.resize(1);
  Pose broken = Pose::Zero();
  broken[kRtibiaRx] = jointLimits().upper[kRtibiaRx] + 0.5;
  clip.poses.push_back(broken);
  Pose doubtful = Pose::Zero();
  doubtful[kRtibiaRx] = jointLimits().upper[kRtibiaRx] + 0.1;
  clip.poses.push_back(doubtful);
  PoseDatabaseConfig config;
  config.mirror = false;
  const PoseDatabaseResult result = buildPoseDatabase({clip}, config);
  EXPECT_EQ(result.counts.beyond_limits, 1U);
  EXPECT_EQ(result.counts.kept, 2U);
}

TEST(BuildPoseDatabase, ZeroThresholdKeepsEveryPose) {
  PoseDatabaseConfig config;
  config.threshold_m = 0;
  EXPECT_EQ(buildPoseDatabase({swingingClip("swing", 0)}, config).counts.kept, 400U);
}

TEST(BuildPoseDatabase, ThreadsDoNotChangeTheResult) {
  PoseDatabaseConfig config;
  const std::vector<MotionClip> clips = {swingingClip("a", 0), swingingClip("b", 1)};
  const PoseDatabase one = buildPoseDatabase(clips, config).database;
  config.threads = 4;
  const PoseDatabase four = buildPoseDatabase(clips, config).database;
  ASSERT_EQ(one.size(), four.size());
  for (std::size_t i = 0; i < one.size(); ++i) EXPECT_EQ(one.poses[i], four.poses[i]);
}

TEST(BuildPoseDatabase, WrongParametersAreNamed) {
  PoseDatabaseConfig config;
  config.threshold_m = -1;
  EXPECT_THROW(buildPoseDatabase({}, config), Error);
  config = {};
  config.beyond_limits_rad = std::nan("");
  EXPECT_THROW(buildPoseDatabase({}, config), Error);
  config = {};
  config.threads = 0;
  EXPECT_THROW(buildPoseDatabase({}, config), Error);
}

}  // namespace
}  // namespace depthmocap
