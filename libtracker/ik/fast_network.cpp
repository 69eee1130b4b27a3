#include "libtracker/ik/fast_network.h"

namespace depthmocap {

FastNetwork::FastNetwork(const DenseNetwork& network)
    : first_W_(network.layers.front().W), last_W_transposed_(network.layers.back().W.transpose()) {
  for (const DenseLayer& layer : network.layers) {
    layers_.push_back({PackedMatrix(layer.W), PackedMatrix(layer.W.transpose()), layer.b});
  }
}

Eigen::VectorXf FastNetwork::evaluate(const Eigen::VectorXf& x, Eigen::MatrixXf* J, int used_outputs) const {
  std::vector<Eigen::VectorXf> slopes;
  Eigen::VectorXf values = x;
  for (std::size_t i = 0; i < layers_.size(); ++i) {
    values = layers_[i].W.times(values) + layers_[i].b;
    if (i + 1 == layers_.size()) break;
    if (J != nullptr) slopes.emplace_back(squareplusSlope(values.array()).matrix());
    values = squareplus(values.array()).matrix();
  }
  if (J == nullptr) return values;
  const int rows = used_outputs > 0 ? used_outputs : outputs();
  // The chain rule from the end that has fewer rows or columns to carry.
  if (rows <= inputs()) {
    Eigen::MatrixXf J_transposed = last_W_transposed_.leftCols(rows);
    for (std::size_t i = layers_.size() - 1; i > 0; --i) {
      J_transposed.array().colwise() *= slopes[i - 1].array();
      J_transposed = layers_[i - 1].W_transposed.times(J_transposed);
    }
    *J = J_transposed.transpose();
  } else {
    *J = first_W_;
    for (std::size_t i = 1; i < layers_.size(); ++i) {
      J->array().colwise() *= slopes[i - 1].array();
      *J = layers_[i].W.times(*J);
    }
    J->conservativeResize(rows, Eigen::NoChange);
  }
  return values;
}

}  // namespace depthmocap
