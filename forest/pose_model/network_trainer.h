#pragma once
#include <Eigen/Core>
#include <vector>

#include "libtracker/core/random.h"
#include "libtracker/ik/dense_network.h"

namespace depthmocap {

// A network of these widths (inputs first, outputs last): weights normal with variance 1 / inputs, thresholds 0.
DenseNetwork randomNetwork(const std::vector<int>& widths, Random& random);

// Learns a network from batches by back-propagation and Adam (Kingma and Ba 2015). One column per sample.
class NetworkTrainer {
 public:
  explicit NetworkTrainer(DenseNetwork network);

  // The outputs for a batch; remembers what backward() needs.
  const Eigen::MatrixXf& forward(const Eigen::MatrixXf& inputs);
  // From the loss' gradient with respect to the outputs of the last forward(): gradients of all weights, and the one
  // with respect to the inputs.
  Eigen::MatrixXf backward(const Eigen::MatrixXf& output_gradient);
  // Moves all weights against the gradients of the last backward().
  void step(float learning_rate);

  [[nodiscard]] const DenseNetwork& network() const { return network_; }
  // Gradients of the last backward(), in the form of a network.
  [[nodiscard]] const DenseNetwork& gradient() const { return gradient_; }

 private:
  DenseNetwork network_;
  DenseNetwork gradient_;
  DenseNetwork mean_;      // of the gradients
  DenseNetwork variance_;  // of the gradients, about 0
  int steps_ = 0;
  std::vector<Eigen::MatrixXf> inputs_;  // of each layer
  std::vector<Eigen::MatrixXf> sums_;    // of each layer before its squareplus
  Eigen::MatrixXf outputs_;
};

}  // namespace depthmocap
