#include "libtracker/ik/ik_solver.h"

#include <numbers>

#include <gtest/gtest.h>

#include "depthmocap/error.h"
#include "libtracker/skeleton/forward_kinematics.h"
#include "libtracker/skeleton/joint_limits.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/ik/some_learned_poses.h"

namespace depthmocap {
namespace {

// A natural pose: one arm raised forward, a step, turned half round.
Pose reaching() {
  Pose q = Pose::Zero();
  q.head<3>() << 1, 0.9, -2;
  q[kRootRy] = 2.5;
  q[kUpperbackRx] = 0.2;
  q[kLhumerusRz] = -0.4;
  q[kLhumerusRy] = -0.8;
  q[kLradiusRy] = -0.6;
  q[kRhumerusRz] = 1.2;
  q[kRradiusRy] = 0.4;
  q[kRfemurRx] = -0.6;
  q[kRtibiaRx] = 0.7;
  return q;
}

JointTargets targetsOf(const Skeleton& skeleton, const Pose& q, const std::vector<Joint>& joints) {
  const JointPositions positions = jointPositions(skeleton, q);
  JointTargets targets;
  for (const Joint joint : joints) EXPECT_EQ(targets.add(joint, positions.col(static_cast<int>(joint))), "");
  return targets;
}

std::vector<Joint> allJoints() {
  std::vector<Joint> joints;
  for (int i = 0; i < kJointCount; ++i) joints.push_back(static_cast<Joint>(i));
  return joints;
}

const std::vector<Joint> kEnds = {Joint::Pelvis,     Joint::Head,      Joint::LeftWrist,
                                  Joint::RightWrist, Joint::LeftAnkle, Joint::RightAnkle};

class EverySolver : public testing::TestWithParam<IkMethod> {
 protected:
  EverySolver() { config_.method = GetParam(); }
  [[nodiscard]] IkResult solve(const JointTargets& targets) const {
    return IkSolver(skeleton_, config_, nullptr).solve(targets);
  }
  Skeleton skeleton_ = makeSkeleton(BoneLengths{});
  IkConfig config_;
};

TEST_P(EverySolver, ReachesTargetsThatCanBeReached) {
  EXPECT_LT(solve(targetsOf(skeleton_, reaching(), kEnds)).residual_m, 0.01);
  EXPECT_LT(solve(targetsOf(skeleton_, reaching(), {Joint::LeftToe})).residual_m, 0.001);
}

TEST_P(EverySolver, FindsThePoseThatAllJointsFix) {
  const IkResult result = solve(targetsOf(skeleton_, reaching(), allJoints()));
  EXPECT_LT(result.residual_m, 0.015);
  EXPECT_NEAR(result.q[kRootRy], 2.5, 0.1);
}

TEST_P(EverySolver, KeepsLimitsAndBoneLengthsWhereTargetsAreOutOfReach) {
  JointTargets targets;
  EXPECT_EQ(targets.add(Joint::LeftWrist, {1.9, 1, 0}), "");
  EXPECT_EQ(targets.add(Joint::RightWrist, {-1.9, 1, 0}), "");
  EXPECT_EQ(targets.add(Joint::RightAnkle, {0, 1, 1.5}), "");
  const IkResult result = solve(targets);
  ASSERT_TRUE(result.q.allFinite());
  EXPECT_EQ(result.q, clampedToLimits(result.q));
  EXPECT_GT(result.residual_m, 0.5);
  EXPECT_LT(result.residual_m, 1.2);
  const JointPositions p = jointPositions(skeleton_, result.q);
  const auto distance = [&](Joint a, Joint b) {
    return (p.col(static_cast<int>(a)) - p.col(static_cast<int>(b))).norm();
  };
  EXPECT_NEAR(distance(Joint::LeftShoulder, Joint::LeftElbow), skeleton_.lengths.upper_arm, 1e-9);
  EXPECT_NEAR(distance(Joint::RightKnee, Joint::RightAnkle), skeleton_.lengths.lower_leg, 1e-9);
  EXPECT_NEAR(distance(Joint::LeftHip, Joint::RightHip), skeleton_.lengths.hip_width, 1e-9);
}

TEST_P(EverySolver, SaysHowFarTheTargetsAreMissed) {
  const JointTargets targets = targetsOf(skeleton_, reaching(), kEnds);
  const IkResult result = solve(targets);
  const JointPositions p = jointPositions(skeleton_, result.q);
  double squares = 0;
  for (const Joint joint : kEnds) {
    const int i = static_cast<int>(joint);
    squares += (p.col(i) - targets.p_world.col(i)).squaredNorm() / static_cast<double>(kEnds.size());
  }
  EXPECT_NEAR(result.residual_m, std::sqrt(squares), 1e-9);
}

TEST_P(EverySolver, GivesTheSameAgain) {
  const JointTargets targets = targetsOf(skeleton_, reaching(), kEnds);
  EXPECT_EQ(solve(targets).q, solve(targets).q);
}

INSTANTIATE_TEST_SUITE_P(Methods, EverySolver,
                         testing::Values(IkMethod::Lm, IkMethod::Jacobian, IkMethod::Ccd, IkMethod::Fabrik),
                         [](const auto& test) {
                           return std::string(kIkMethodNames[static_cast<std::size_t>(test.param)]);
                         });

class EveryPrior : public testing::TestWithParam<IkPrior> {};

TEST_P(EveryPrior, KeepsLimitsAndStaysFinite) {
  const Skeleton skeleton = makeSkeleton(BoneLengths{});
  IkConfig config;
  config.prior = GetParam();
  const IkSolver solver(skeleton, config, std::make_shared<LearnedPoses>(someLearnedPoses()));
  const JointTargets near = targetsOf(skeleton, reaching(), kEnds);
  const IkResult result = solver.solve(near);
  EXPECT_EQ(result.q, clampedToLimits(result.q));
  EXPECT_EQ(result.q, solver.solve(near).q);
  EXPECT_LE(std::abs(result.q[kRootRy]), std::numbers::pi);
  JointTargets far;
  EXPECT_EQ(far.add(Joint::LeftWrist, {3, 0, 0}), "");
  EXPECT_EQ(far.add(Joint::RightToe, {0, 0, 0}), "");
  EXPECT_TRUE(solver.solve(far).q.allFinite());
}

TEST(LatentSolver, FindsWhatTheDecoderCanMake) {
  const Skeleton skeleton = makeSkeleton(BoneLengths{});
  const auto learned = std::make_shared<LearnedPoses>(someLearnedPoses());
  IkConfig config;
  config.method = IkMethod::Latent;
  const IkSolver solver(skeleton, config, learned);
  // A pose of a small code, near which the weight of the code has little to say.
  const Eigen::VectorXf code = Eigen::VectorXf::LinSpaced(5, -0.3F, 0.3F);
  Pose truth = withShape(Pose::Zero(), learned->scale.unscaled(learned->variational.decoder.evaluate(code)));
  truth = clampedToLimits(truth);
  truth[kRootTx] = 0.4;
  truth[kRootRy] = 1.1;
  const JointPositions joints = jointPositions(skeleton, truth);
  JointTargets targets;
  for (int i = 0; i < kJointCount; ++i) ASSERT_EQ(targets.add(static_cast<Joint>(i), joints.col(i)), "");
  const IkResult result = solver.solve(targets);
  EXPECT_LT(result.residual_m, 0.05);
  EXPECT_EQ(result.q, clampedToLimits(result.q));
  EXPECT_EQ(result.q, solver.solve(targets).q);
}

INSTANTIATE_TEST_SUITE_P(
    Priors, EveryPrior, testing::Values(IkPrior::None, IkPrior::Ppca, IkPrior::Gmm, IkPrior::Autoencoder, IkPrior::Vae),
    [](const auto& test) { return std::string(kIkPriorNames[static_cast<std::size_t>(test.param)]); });

TEST(IkConfig, RefusesWhatCannotBe) {
  IkConfig config;
  config.method = IkMethod::Ccd;
  config.prior = IkPrior::Gmm;
  EXPECT_THROW(config.validate(), Error);
  config = {};
  config.weight_m = -1;
  EXPECT_THROW(config.validate(), Error);
  config = {};
  config.starts = 0;
  EXPECT_THROW(config.validate(), Error);
}

}  // namespace
}  // namespace depthmocap
