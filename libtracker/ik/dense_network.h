#pragma once
#include <Eigen/Core>
#include <vector>

namespace depthmocap {

// squareplus(x) = (x + sqrt(x^2 + 4)) / 2 (Barron 2021): a ReLU without its kink, so that Jacobians are continuous; of
// operations that IEEE 754 fixes to the last bit. And its derivative.
Eigen::ArrayXXf squareplus(const Eigen::ArrayXXf& x);
Eigen::ArrayXXf squareplusSlope(const Eigen::ArrayXXf& x);

struct DenseLayer {
  Eigen::MatrixXf W;  // outputs x inputs
  Eigen::VectorXf b;
};

// Fully connected layers with squareplus between them, none after the last.
struct DenseNetwork {
  std::vector<DenseLayer> layers;  // at least one

  [[nodiscard]] int inputs() const { return static_cast<int>(layers.front().W.cols()); }
  [[nodiscard]] int outputs() const { return static_cast<int>(layers.back().W.rows()); }
  // The outputs for x; J: outputs x inputs, or nullptr.
  [[nodiscard]] Eigen::VectorXf evaluate(const Eigen::VectorXf& x, Eigen::MatrixXf* J = nullptr) const;
};

}  // namespace depthmocap
