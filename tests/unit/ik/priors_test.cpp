#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "libtracker/ik/latent_problem.h"
#include "libtracker/ik/pose_problem.h"
#include "libtracker/ik/target_term.h"
#include "libtracker/skeleton/joint_limits.h"
#include "tests/unit/ik/problem_gradient.h"
#include "tests/unit/ik/some_learned_poses.h"

namespace depthmocap {
namespace {

// Networks work in single precision, so differences need a larger step.
constexpr double kStep = 1e-2;
constexpr double kTolerance = 3e-3;

class Priors : public testing::Test {
 protected:
  Priors() {
    Random random(3);
    q_.tail<kDofCount - kFirstRotationDof>().setConstant(0.1);
    q_ = withShape(q_, someShape(random, 0.1));
    q_ = clampedToLimits(q_);
    const JointPositions joints = jointPositions(skeleton_, Pose::Zero());
    for (const Joint joint : {Joint::LeftWrist, Joint::RightToe, Joint::Head}) {
      EXPECT_EQ(targets_.add(joint, joints.col(static_cast<int>(joint))), "");
    }
  }
  Skeleton skeleton_ = makeSkeleton(BoneLengths{});
  LearnedPoses learned_ = someLearnedPoses();
  JointTargets targets_;
  Pose q_ = Pose::Zero();
};

TEST_F(Priors, GradientOfTheTargets) {
  TargetTerm term(skeleton_, targets_);
  PoseProblem problem(term);
  expectGradient(problem, q_, 1e-6, 1e-5);
}

TEST_F(Priors, GradientOfPpcaAndMixture) {
  for (const auto& components : {std::vector{learned_.ppca}, learned_.mixture}) {
    const GaussianPrior prior(components);
    TargetTerm term(skeleton_, targets_);
    PoseProblem problem(term, &prior, 0.7);
    expectGradient(problem, q_, 1e-6, 1e-5);
  }
}

TEST_F(Priors, GradientOfTheAutoencoder) {
  const AutoencoderPrior prior(learned_.scale, learned_.autoencoder);
  TargetTerm term(skeleton_, targets_);
  PoseProblem problem(term, &prior, 0.7);
  expectGradient(problem, q_, kTolerance, kStep);
}

TEST_F(Priors, GradientOfTheVariationalAutoencoder) {
  const VariationalPrior prior(learned_.scale, learned_.variational, 0.4);
  ASSERT_EQ(prior.rows(), kShapeDofCount + 5);
  TargetTerm term(skeleton_, targets_);
  PoseProblem problem(term, &prior, 0.7);
  expectGradient(problem, q_, kTolerance, kStep);
}

TEST_F(Priors, LatentProblemJacobian) {
  const FastPoseCoder coder(learned_.variational);
  TargetTerm term(skeleton_, targets_);
  LatentProblem problem(learned_.scale, coder, term);
  expectGradient(problem, problem.encoded(q_), kTolerance, kStep);
}

TEST_F(Priors, PpcaIsTheMahalanobisDistance) {
  const PoseGaussian& g = learned_.ppca;
  Eigen::MatrixXd covariance = g.residual_rad * g.residual_rad * Eigen::MatrixXd::Identity(32, 32);
  for (int k = 0; k < 3; ++k) covariance(3 * k + 4, 3 * k + 4) = g.deviation[k] * g.deviation[k];
  const GaussianPrior prior({g});
  Eigen::VectorXd r(prior.rows());
  prior.evaluate(shapeOf(q_), r, nullptr);
  const PoseShape d = shapeOf(q_) - g.mean;
  EXPECT_NEAR(r.squaredNorm(), d.dot(covariance.ldlt().solve(d)), 1e-9);
}

TEST_F(Priors, MixtureTakesTheMoreProbableGaussian) {
  PoseGaussian rare = learned_.ppca;
  rare.weight = 0.2;
  PoseGaussian often = rare;
  often.weight = 0.8;
  often.mean[5] += 1;  // across the basis: 10 deviations away
  const GaussianPrior prior({rare, often});
  Eigen::VectorXd r(prior.rows());
  prior.evaluate(often.mean, r, nullptr);
  EXPECT_NEAR(r.squaredNorm(), 0, 1e-12);
  prior.evaluate(rare.mean, r, nullptr);
  EXPECT_NEAR(r.squaredNorm(), 2 * std::log(4.0), 1e-9);
}

TEST_F(Priors, PlaceAndHeadingHaveNoPrior) {
  const GaussianPrior prior({learned_.ppca});
  TargetTerm term(skeleton_, targets_);
  PoseProblem problem(term, &prior, 0.7);
  Eigen::VectorXd E(problem.residuals());
  Eigen::MatrixXd J(problem.residuals(), kDofCount);
  problem.evaluate(q_, E, &J);
  for (const int dof : {kRootTx, kRootTy, kRootTz, kRootRy}) {
    EXPECT_EQ(J.col(dof).tail(prior.rows()).norm(), 0);
    EXPECT_GT(J.col(dof).norm(), 0);
  }
}

TEST(DenseNetwork, JacobianFollowsEitherChain) {
  Random random(5);
  for (const auto& widths : {std::vector{4, 9, 7}, std::vector{7, 9, 8, 4}}) {
    const DenseNetwork network = someNetwork(widths, random);
    const auto residual = [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
      return network.evaluate(x.cast<float>()).cast<double>();
    };
    const auto jacobian = [&](const Eigen::VectorXd& x) -> Eigen::MatrixXd {
      Eigen::MatrixXf J;
      (void)network.evaluate(x.cast<float>(), &J);
      return J.cast<double>();
    };
    expectJacobianMatches(Eigen::VectorXd::LinSpaced(network.inputs(), -1, 1), residual, jacobian, kTolerance, kStep);
  }
}

TEST(FastNetwork, DoesWhatThePlainNetworkDoes) {
  Random random(6);
  for (const auto& widths : {std::vector{4, 9, 7}, std::vector{33, 128, 17, 20}, std::vector{24, 31, 64, 32}}) {
    const DenseNetwork plain = someNetwork(widths, random);
    const FastNetwork fast(plain);
    Eigen::MatrixXf J_plain;
    Eigen::MatrixXf J_fast;
    const Eigen::VectorXf x = Eigen::VectorXf::LinSpaced(plain.inputs(), -1, 1);
    EXPECT_LT((plain.evaluate(x, &J_plain) - fast.evaluate(x, &J_fast)).norm(), 1e-4);
    ASSERT_EQ(J_fast.rows(), J_plain.rows());
    EXPECT_LT((J_plain - J_fast).norm(), 1e-3);
    EXPECT_EQ(fast.evaluate(x), fast.evaluate(x, &J_fast));
    for (const int used : {1, 3}) {
      (void)fast.evaluate(x, &J_fast, used);
      EXPECT_LT((J_plain.topRows(used) - J_fast).norm(), 1e-3) << used;
    }
  }
}

// The same sums whichever way the processor takes.
TEST(PackedMatrix, SumsInTheOrderOfTheColumns) {
  Random random(7);
  for (const auto& [rows, inner, columns] : {std::array{1, 1, 1}, std::array{16, 5, 6}, std::array{35, 40, 23}}) {
    Eigen::MatrixXf A(rows, inner);
    Eigen::MatrixXf B(inner, columns);
    for (float& a : A.reshaped()) a = static_cast<float>(random.normal());
    for (float& b : B.reshaped()) b = static_cast<float>(random.normal());
    const Eigen::MatrixXf C = PackedMatrix(A).times(B);
    for (int i = 0; i < rows; ++i) {
      for (int j = 0; j < columns; ++j) {
        float sum = 0;
        for (int k = 0; k < inner; ++k) sum += A(i, k) * B(k, j);
        EXPECT_EQ(C(i, j), sum) << i << ' ' << j;
      }
    }
  }
}

}  // namespace
}  // namespace depthmocap
