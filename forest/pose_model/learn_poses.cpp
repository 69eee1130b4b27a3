#include "forest/pose_model/learn_poses.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include <fmt/format.h>

#include "depthmocap/error.h"
#include "forest/pose_model/fit_pose_mixture.h"
#include "forest/pose_model/network_trainer.h"
#include "libtracker/core/config_fields.h"

namespace depthmocap {
namespace {

constexpr double kLeastDeviation_rad = 1e-3;
constexpr float kLeastLogVariance = -12.0F;  // of the latent code; its exponential stays in range
constexpr float kMostLogVariance = 4.0F;

PoseShape shapeAt(const PoseDatabase& database, std::size_t i) {
  return shapeOf(database.pose(i));
}

PoseScale scaleOf(const PoseDatabase& database) {
  PoseScale scale;
  PoseShape squares = PoseShape::Zero();
  const auto count = static_cast<double>(database.size());
  for (std::size_t i = 0; i < database.size(); ++i) {
    scale.mean += shapeAt(database, i) / count;
    squares += shapeAt(database, i).cwiseAbs2() / count;
  }
  scale.deviation = (squares - scale.mean.cwiseAbs2()).cwiseMax(0).cwiseSqrt().cwiseMax(kLeastDeviation_rad);
  return scale;
}

std::vector<PoseGaussian> gaussians(const PoseDatabase& database, const PoseLearningConfig& config, int components) {
  PoseMixtureConfig mixture_config;
  mixture_config.components = components;
  mixture_config.seed = config.seed;
  mixture_config.threads = config.threads;
  std::vector<PoseGaussian> result;
  for (const auto& component : fitPoseMixture(database, mixture_config).components) {
    PoseGaussian g;
    g.weight = static_cast<double>(component.weight);
    g.mean = shapeOf(component.mean.cast<double>());
    g.basis.resize(kShapeDofCount, PoseMixture::kDims);
    for (int k = 0; k < PoseMixture::kDims; ++k) g.basis.col(k) = shapeOf(component.basis.col(k).cast<double>());
    g.deviation = component.deviation.cast<double>().cwiseMax(kLeastDeviation_rad);
    g.residual_rad = std::max(kLeastDeviation_rad, static_cast<double>(component.residual));
    result.push_back(std::move(g));
  }
  return result;
}

// Batches of scaled poses in a new random order each epoch, with the learning rate of each step.
class Lessons {
 public:
  Lessons(const PoseDatabase& database, const PoseScale& scale, const PoseLearningConfig& config, Random& random)
      : config_(config),
        random_(random),
        poses_(kShapeDofCount, static_cast<Eigen::Index>(database.size())),
        order_(database.size()) {
    for (std::size_t i = 0; i < database.size(); ++i) {
      poses_.col(static_cast<Eigen::Index>(i)) = scale.scaled(shapeAt(database, i));
    }
    std::iota(order_.begin(), order_.end(), Eigen::Index{0});
  }
  [[nodiscard]] std::size_t steps() const {
    return static_cast<std::size_t>(config_.epochs) * std::max<std::size_t>(1, order_.size() / batch());
  }
  Eigen::MatrixXf next() {
    if (at_ == 0) {
      for (std::size_t i = order_.size() - 1; i > 0; --i) {
        std::swap(order_[i], order_[random_.below(static_cast<std::uint32_t>(i + 1))]);
      }
    }
    const std::size_t count = std::min(batch(), order_.size());
    Eigen::MatrixXf poses(kShapeDofCount, static_cast<Eigen::Index>(count));
    for (std::size_t i = 0; i < count; ++i) poses.col(static_cast<Eigen::Index>(i)) = poses_.col(order_[at_ + i]);
    at_ += count;
    if (at_ + count > order_.size()) at_ = 0;
    ++step_;
    return poses;
  }
  [[nodiscard]] float rate() const {
    const double share = static_cast<double>(step_) / static_cast<double>(steps());
    return static_cast<float>(0.5 * config_.learning_rate * (1.0 + std::cos(std::numbers::pi * share)));
  }
  Eigen::MatrixXf normal(Eigen::Index rows, Eigen::Index cols) {
    Eigen::MatrixXf values(rows, cols);
    for (float& value : values.reshaped()) value = static_cast<float>(random_.normal());
    return values;
  }

 private:
  [[nodiscard]] std::size_t batch() const { return static_cast<std::size_t>(config_.batch); }

  const PoseLearningConfig& config_;
  Random& random_;
  Eigen::MatrixXf poses_;
  std::vector<Eigen::Index> order_;
  std::size_t at_ = 0;
  std::size_t step_ = 0;
};

using Tick = std::function<void()>;

// Four layers each, as in the paper.
PoseCoder learnAutoencoder(Lessons lessons, const PoseLearningConfig& config, Random& random, const Tick& tick) {
  const int w = config.width;
  NetworkTrainer encoder(randomNetwork({kShapeDofCount, w, w, w, config.code}, random));
  NetworkTrainer decoder(randomNetwork({config.code, w, w, w, kShapeDofCount}, random));
  for (std::size_t step = 0; step < lessons.steps(); ++step) {
    const Eigen::MatrixXf poses = lessons.next();
    Eigen::MatrixXf seen = poses;
    if (config.noise > 0) seen += static_cast<float>(config.noise) * lessons.normal(poses.rows(), poses.cols());
    const Eigen::MatrixXf& rebuilt = decoder.forward(encoder.forward(seen));
    const Eigen::MatrixXf gradient = 2.0F / static_cast<float>(poses.size()) * (rebuilt - poses);
    encoder.backward(decoder.backward(gradient));
    decoder.step(lessons.rate());
    encoder.step(lessons.rate());
    tick();
  }
  return {encoder.network(), decoder.network()};
}

PoseCoder learnVariational(Lessons lessons, const PoseLearningConfig& config, Random& random, const Tick& tick) {
  const int w = config.width;
  const int latent = config.latent;
  NetworkTrainer encoder(randomNetwork({kShapeDofCount, w, w, 2 * latent}, random));
  NetworkTrainer decoder(randomNetwork({latent, w, w, kShapeDofCount}, random));
  for (std::size_t step = 0; step < lessons.steps(); ++step) {
    const Eigen::MatrixXf poses = lessons.next();
    const Eigen::MatrixXf code = encoder.forward(poses);
    const Eigen::ArrayXXf mean = code.topRows(latent);
    const Eigen::ArrayXXf log_variance = code.bottomRows(latent).array().max(kLeastLogVariance).min(kMostLogVariance);
    const Eigen::ArrayXXf deviation = (0.5F * log_variance).unaryExpr([](float value) { return std::exp(value); });
    const Eigen::ArrayXXf noise = lessons.normal(latent, poses.cols());
    const Eigen::MatrixXf& rebuilt = decoder.forward((mean + deviation * noise).matrix());
    const float per_value = 1.0F / static_cast<float>(poses.size());
    const Eigen::ArrayXXf from_decoder = decoder.backward(2.0F * per_value * (rebuilt - poses)).array();
    // The divergence of N(mean, deviation^2) from N(0, 1) is 1/2 sum (mean^2 + variance - log variance - 1).
    const float kl = static_cast<float>(config.kl_weight) * per_value;
    Eigen::MatrixXf gradient(2 * latent, poses.cols());
    gradient.topRows(latent) = from_decoder + kl * mean;
    gradient.bottomRows(latent) = 0.5F * from_decoder * deviation * noise + 0.5F * kl * (deviation.square() - 1.0F);
    encoder.backward(gradient);
    decoder.step(lessons.rate());
    encoder.step(lessons.rate());
    tick();
  }
  return {encoder.network(), decoder.network()};
}

}  // namespace

void PoseLearningConfig::validate() const {
  const char* name = "PoseLearningConfig";
  checkConfig(components >= 1, name, "components", components, "at least 1");
  checkConfig(width >= 1, name, "width", width, "at least 1");
  checkConfig(code >= 1 && code < kShapeDofCount, name, "code", code, "from 1 to 31");
  checkConfig(latent >= 1 && latent < kShapeDofCount, name, "latent", latent, "from 1 to 31");
  checkConfig(noise >= 0, name, "noise", noise, "at least 0");
  checkConfig(kl_weight > 0, name, "kl_weight", kl_weight, "above 0");
  checkConfig(epochs >= 1, name, "epochs", epochs, "at least 1");
  checkConfig(batch >= 1, name, "batch", batch, "at least 1");
  checkConfig(learning_rate > 0, name, "learning_rate", learning_rate, "above 0");
  checkConfig(threads >= 1, name, "threads", threads, "at least 1");
}

LearnedPoses learnPoses(const PoseDatabase& database, const PoseLearningConfig& config,
                        const std::function<void(std::size_t, std::size_t)>& progress) {
  config.validate();
  LearnedPoses learned;
  learned.scale = scaleOf(database);
  learned.ppca = gaussians(database, config, 1).front();
  learned.mixture = gaussians(database, config, config.components);
  Random random(config.seed);
  const Lessons lessons(database, learned.scale, config, random);
  std::size_t done = 0;
  const Tick tick = [&] { progress(++done, 2 * lessons.steps()); };
  learned.autoencoder = learnAutoencoder(lessons, config, random, tick);
  learned.variational = learnVariational(lessons, config, random, tick);
  return learned;
}

PoseLearningError learningError(const LearnedPoses& learned, const PoseDatabase& database) {
  PoseLearningError error;
  const auto add = [&](double& sum, const PoseShape& shape, const PoseShape& rebuilt) {
    const double squares = ((shape - rebuilt).array() / learned.scale.deviation.array()).square().mean();
    sum += squares / static_cast<double>(database.size());
  };
  for (std::size_t i = 0; i < database.size(); ++i) {
    const PoseShape shape = shapeAt(database, i);
    const auto& basis = learned.ppca.basis;
    add(error.ppca, shape, learned.ppca.mean + basis * (basis.transpose() * (shape - learned.ppca.mean)));
    const auto through = [&](const PoseCoder& coder) {
      const Eigen::VectorXf code = coder.encoder.evaluate(learned.scale.scaled(shape));
      return learned.scale.unscaled(coder.decoder.evaluate(code.head(coder.decoder.inputs())));
    };
    add(error.autoencoder, shape, through(learned.autoencoder));
    add(error.variational, shape, through(learned.variational));
  }
  return {std::sqrt(error.ppca), std::sqrt(error.autoencoder), std::sqrt(error.variational)};
}

}  // namespace depthmocap
