#pragma once
#include <cmath>

#include "libtracker/core/random.h"
#include "libtracker/ik/learned_poses.h"

namespace depthmocap {

inline DenseNetwork someNetwork(const std::vector<int>& widths, Random& random) {
  DenseNetwork network;
  for (std::size_t i = 0; i + 1 < widths.size(); ++i) {
    DenseLayer layer{Eigen::MatrixXf(widths[i + 1], widths[i]), Eigen::VectorXf(widths[i + 1])};
    for (float& w : layer.W.reshaped()) w = static_cast<float>(random.normal() / std::sqrt(widths[i]));
    for (float& b : layer.b) b = static_cast<float>(0.1 * random.normal());
    network.layers.push_back(std::move(layer));
  }
  return network;
}

inline PoseShape someShape(Random& random, double deviation_rad) {
  PoseShape shape;
  for (double& x : shape) x = deviation_rad * random.normal();
  return shape;
}

inline PoseGaussian someGaussian(Random& random, double weight) {
  PoseGaussian g;
  g.weight = weight;
  g.mean = someShape(random, 0.3);
  g.basis.setZero(kShapeDofCount, 3);
  for (int k = 0; k < 3; ++k) g.basis(3 * k + 4, k) = 1;
  g.deviation = Eigen::Vector3d(0.5, 0.4, 0.3);
  g.residual_rad = 0.1;
  return g;
}

// Learned from nothing: small, and all of its parts differ.
inline LearnedPoses someLearnedPoses() {
  Random random(11);
  LearnedPoses poses;
  poses.ppca = someGaussian(random, 1);
  poses.mixture = {someGaussian(random, 0.25), someGaussian(random, 0.75)};
  poses.scale.mean = someShape(random, 0.1);
  poses.scale.deviation.setConstant(0.5);
  poses.autoencoder = {someNetwork({kShapeDofCount, 16, 6}, random), someNetwork({6, 16, kShapeDofCount}, random)};
  poses.variational = {someNetwork({kShapeDofCount, 16, 10}, random), someNetwork({5, 16, kShapeDofCount}, random)};
  poses.origin = "random numbers";
  return poses;
}

}  // namespace depthmocap
