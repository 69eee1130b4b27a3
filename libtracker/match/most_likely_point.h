#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "depthmocap/parts.h"

namespace depthmocap {

// How a measured point is compared with points of the body's surface.
struct PointLikelihood {
  double sigma_m;          // [m] (> 0) how far the surface is expected from a point of its part
  double reach_m;          // [m] (> 0) a point further from its surface point has no match
  double min_probability;  // (0, 1] no part is held less likely: the classifier may be wrong
};

// The surface point that `p_world` [m] most likely lies on, by its distance and by the probability of each part.
// `parts` holds the surface points of each part (index = partIndex(part)), which have a member p_world. Null: none is
// in reach.
template <typename Point>
const Point* mostLikelyPoint(const std::array<std::vector<Point>, kPartCount>& parts, const Eigen::Vector3f& p_world,
                             const std::array<float, kPartCount>& probability, const PointLikelihood& likelihood) {
  const auto per_square = static_cast<float>(0.5 / (likelihood.sigma_m * likelihood.sigma_m));
  const auto farthest = static_cast<float>(likelihood.reach_m * likelihood.reach_m);
  const auto min_probability = static_cast<float>(likelihood.min_probability);
  float best_cost = std::numeric_limits<float>::max();
  const Point* best = nullptr;
  for (std::size_t part = 0; part < kPartCount; ++part) {
    // Negative log likelihoods: half the squared distance over sigma^2, and what the classifier thinks of the part.
    const float doubt = -std::log(std::max(probability[part], min_probability));
    if (doubt >= best_cost) continue;
    for (const Point& point : parts[part]) {
      const float square = (point.p_world - p_world).squaredNorm();
      const float cost = square * per_square + doubt;
      if (cost >= best_cost || square > farthest) continue;
      best_cost = cost;
      best = &point;
    }
  }
  return best;
}

// Weight (0, 1] of a match whose point is `off_m` [m] off the surface: Lorentzian of width `sigma_m` [m] (> 0).
inline double lorentzianWeight(double off_m, double sigma_m) {
  return 1.0 / (1.0 + off_m * off_m / (2.0 * sigma_m * sigma_m));
}

}  // namespace depthmocap
