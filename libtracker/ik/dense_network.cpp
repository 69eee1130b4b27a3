#include "libtracker/ik/dense_network.h"

namespace depthmocap {

Eigen::ArrayXXf squareplus(const Eigen::ArrayXXf& x) {
  return 0.5F * (x + (x.square() + 4.0F).sqrt());
}

Eigen::ArrayXXf squareplusSlope(const Eigen::ArrayXXf& x) {
  return 0.5F * (1.0F + x / (x.square() + 4.0F).sqrt());
}

Eigen::VectorXf DenseNetwork::evaluate(const Eigen::VectorXf& x, Eigen::MatrixXf* J) const {
  std::vector<Eigen::VectorXf> slopes;
  Eigen::VectorXf values = x;
  for (std::size_t i = 0; i < layers.size(); ++i) {
    values = (layers[i].W * values + layers[i].b).eval();
    if (i + 1 == layers.size()) break;
    if (J != nullptr) slopes.emplace_back(squareplusSlope(values.array()).matrix());
    values = squareplus(values.array()).matrix();
  }
  if (J == nullptr) return values;
  // The chain rule from the end that has fewer rows or columns to carry.
  if (outputs() <= inputs()) {
    *J = layers.back().W;
    for (std::size_t i = layers.size() - 1; i > 0; --i) *J = (*J * slopes[i - 1].asDiagonal() * layers[i - 1].W).eval();
  } else {
    *J = layers.front().W;
    for (std::size_t i = 1; i < layers.size(); ++i) *J = (layers[i].W * (slopes[i - 1].asDiagonal() * *J)).eval();
  }
  return values;
}

}  // namespace depthmocap
