#include "forest/pose_model/network_trainer.h"

#include <cmath>

namespace depthmocap {
namespace {

constexpr float kMeanDecay = 0.9F;
constexpr float kVarianceDecay = 0.999F;
constexpr float kEpsilon = 1e-8F;

DenseNetwork zerosLike(DenseNetwork network) {
  for (DenseLayer& layer : network.layers) {
    layer.W.setZero();
    layer.b.setZero();
  }
  return network;
}

template <typename Matrix>
void adam(const Matrix& gradient, Matrix& mean, Matrix& variance, Matrix& weights, float rate) {
  mean = kMeanDecay * mean + (1.0F - kMeanDecay) * gradient;
  variance = kVarianceDecay * variance + (1.0F - kVarianceDecay) * gradient.cwiseAbs2();
  weights.array() -= rate * mean.array() / (variance.array().sqrt() + kEpsilon);
}

}  // namespace

DenseNetwork randomNetwork(const std::vector<int>& widths, Random& random) {
  DenseNetwork network;
  for (std::size_t i = 0; i + 1 < widths.size(); ++i) {
    DenseLayer layer{Eigen::MatrixXf(widths[i + 1], widths[i]), Eigen::VectorXf::Zero(widths[i + 1])};
    const double deviation = std::sqrt(1.0 / widths[i]);
    for (float& w : layer.W.reshaped()) w = static_cast<float>(deviation * random.normal());
    network.layers.push_back(std::move(layer));
  }
  return network;
}

NetworkTrainer::NetworkTrainer(DenseNetwork network)
    : network_(std::move(network)),
      gradient_(zerosLike(network_)),
      mean_(gradient_),
      variance_(gradient_),
      inputs_(network_.layers.size()),
      sums_(network_.layers.size()) {}

const Eigen::MatrixXf& NetworkTrainer::forward(const Eigen::MatrixXf& inputs) {
  inputs_[0] = inputs;
  for (std::size_t i = 0; i < network_.layers.size(); ++i) {
    const DenseLayer& layer = network_.layers[i];
    sums_[i].noalias() = layer.W * inputs_[i];
    sums_[i].colwise() += layer.b;
    if (i + 1 < network_.layers.size()) inputs_[i + 1] = squareplus(sums_[i].array()).matrix();
  }
  outputs_ = sums_.back();
  return outputs_;
}

Eigen::MatrixXf NetworkTrainer::backward(const Eigen::MatrixXf& output_gradient) {
  Eigen::MatrixXf g = output_gradient;
  for (std::size_t i = network_.layers.size(); i-- > 0;) {
    gradient_.layers[i].W.noalias() = g * inputs_[i].transpose();
    gradient_.layers[i].b = g.rowwise().sum();
    g = (network_.layers[i].W.transpose() * g).eval();
    if (i > 0) g.array() *= squareplusSlope(sums_[i - 1].array());
  }
  return g;
}

void NetworkTrainer::step(float learning_rate) {
  ++steps_;
  const double unbiased = std::sqrt(1.0 - std::pow(kVarianceDecay, steps_)) / (1.0 - std::pow(kMeanDecay, steps_));
  const float rate = learning_rate * static_cast<float>(unbiased);
  for (std::size_t i = 0; i < network_.layers.size(); ++i) {
    adam(gradient_.layers[i].W, mean_.layers[i].W, variance_.layers[i].W, network_.layers[i].W, rate);
    adam(gradient_.layers[i].b, mean_.layers[i].b, variance_.layers[i].b, network_.layers[i].b, rate);
  }
}

}  // namespace depthmocap
