#include "libtracker/ik/ik_experiment.h"

#include <gtest/gtest.h>

#include "libtracker/skeleton/forward_kinematics.h"

namespace depthmocap {
namespace {

PoseDatabase twoPoses() {
  PoseDatabase database;
  Pose q = Pose::Zero();
  q[kRhumerusRz] = 1;
  database.poses = {Eigen::Matrix<float, kDofCount, 1>::Zero(), q.cast<float>()};
  return database;
}

TEST(IkExperiment, TargetsAreJointsOfTheTruthPlusNoise) {
  const Skeleton skeleton = makeSkeleton(BoneLengths{});
  IkExperimentConfig config;
  config.poses = 50;
  config.joints = 10;
  config.noise_m = 0.02;
  double squares = 0;
  for (const IkTask& task : ikTasks(twoPoses(), skeleton, config)) {
    EXPECT_EQ(task.targets.count(), 10);
    const JointPositions joints = jointPositions(skeleton, task.truth);
    for (int i = 0; i < kJointCount; ++i) {
      if (task.targets.has(static_cast<Joint>(i)))
        squares += (joints.col(i) - task.targets.p_world.col(i)).squaredNorm();
    }
  }
  EXPECT_NEAR(std::sqrt(squares / (50 * 10 * 3)), 0.02, 0.002);
}

TEST(IkExperiment, TasksDependOnTheSeed) {
  const Skeleton skeleton = makeSkeleton(BoneLengths{});
  IkExperimentConfig config;
  const auto first = [&] { return ikTasks(twoPoses(), skeleton, config).front(); };
  EXPECT_EQ(first().truth, first().truth);
  EXPECT_EQ(first().targets.given, first().targets.given);
  const Pose truth = first().truth;
  config.seed = 2;
  EXPECT_NE(first().truth, truth);
}

TEST(IkExperiment, WithAllJointsGivenTheErrorIsSmall) {
  const Skeleton skeleton = makeSkeleton(BoneLengths{});
  IkExperimentConfig config;
  config.poses = 10;
  config.joints = kJointCount;
  const IkSolver solver(skeleton, {}, nullptr);
  const IkFigures figures = measureIk(solver, ikTasks(twoPoses(), skeleton, config), 2);
  EXPECT_LT(figures.position_m, 0.001);
  EXPECT_GT(figures.solve_ms, 0);
}

}  // namespace
}  // namespace depthmocap
