#include "forest/pose_model/learn_poses.h"

#include <gtest/gtest.h>

#include "depthmocap/error.h"
#include "forest/pose_model/network_trainer.h"
#include "tests/gradient_check.h"

namespace depthmocap {
namespace {

// Poses along one bent line: elbow, knee and spine follow one number.
PoseDatabase bentLine(int count) {
  PoseDatabase database;
  Random random(5);
  for (int i = 0; i < count; ++i) {
    const double s = random.uniform(-1, 1);
    Pose q = Pose::Zero();
    q[kLradiusRy] = -1 + s;
    q[kRtibiaRx] = 0.8 + 0.7 * s * s;
    q[kUpperbackRx] = 0.3 * std::sin(3 * s);
    database.poses.push_back(q.cast<float>());
  }
  return database;
}

PoseLearningConfig smallConfig() {
  PoseLearningConfig config;
  config.components = 4;
  config.width = 16;
  config.code = 3;
  config.latent = 3;
  config.noise = 0;
  config.epochs = 25;
  config.batch = 20;
  config.learning_rate = 1e-2;
  return config;
}

const auto kSilent = [](std::size_t, std::size_t) {};

TEST(NetworkTrainer, GradientMatchesDifferences) {
  Random random(2);
  const Eigen::MatrixXf inputs = Eigen::MatrixXf::Random(4, 3);
  const DenseNetwork network = randomNetwork({4, 6, 5, 2}, random);
  // The loss is half the squared outputs; its weights of the middle layer are the variables.
  const auto withWeights = [&](const Eigen::VectorXd& x) {
    DenseNetwork changed = network;
    changed.layers[1].W.reshaped() = x.cast<float>();
    return NetworkTrainer(changed);
  };
  const auto loss = [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
    const Eigen::MatrixXd out = withWeights(x).forward(inputs).cast<double>();
    return Eigen::VectorXd::Constant(1, 0.5 * out.squaredNorm());
  };
  const auto gradient = [&](const Eigen::VectorXd& x) -> Eigen::MatrixXd {
    NetworkTrainer trainer = withWeights(x);
    const Eigen::MatrixXf out = trainer.forward(inputs);
    trainer.backward(out);
    return trainer.gradient().layers[1].W.reshaped().cast<double>().transpose();
  };
  expectJacobianMatches(network.layers[1].W.reshaped().cast<double>(), loss, gradient, 3e-3, 1e-2);
}

TEST(LearnPoses, CodersRebuildPosesThatALineCannotHold) {
  const PoseDatabase database = bentLine(600);
  std::size_t done = 0;
  const LearnedPoses learned = learnPoses(database, smallConfig(), [&](std::size_t now, std::size_t) { done = now; });
  EXPECT_EQ(done, 2U * 25U * 30U);
  const PoseLearningError error = learningError(learned, database);
  EXPECT_LT(error.autoencoder, 0.15);  // 0.3 is what the mean pose leaves
  EXPECT_LT(error.variational, 0.12);
  EXPECT_LE(learned.mixture.size(), 4U);
  double weights = 0;
  for (const PoseGaussian& g : learned.mixture) weights += g.weight;
  EXPECT_NEAR(weights, 1, 1e-5);
}

TEST(LearnPoses, DependsOnTheSeedAndNotOnThreads) {
  const PoseDatabase database = bentLine(200);
  PoseLearningConfig config = smallConfig();
  config.epochs = 1;
  config.threads = 1;
  const auto weightsOf = [&] { return learnPoses(database, config, kSilent).variational.encoder.layers[0].W; };
  const Eigen::MatrixXf one = weightsOf();
  config.threads = 3;
  EXPECT_EQ(weightsOf(), one);
  config.seed = 2;
  EXPECT_NE(weightsOf(), one);
}

TEST(LearnPoses, RefusesBadOptions) {
  PoseLearningConfig config = smallConfig();
  config.code = 32;
  EXPECT_THROW(config.validate(), Error);
  config = smallConfig();
  config.batch = 0;
  EXPECT_THROW(config.validate(), Error);
  config = smallConfig();
  config.kl_weight = 0;
  EXPECT_THROW(config.validate(), Error);
}

}  // namespace
}  // namespace depthmocap
