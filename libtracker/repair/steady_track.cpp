#include "libtracker/repair/steady_track.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace depthmocap {
namespace {

using State = Eigen::Matrix<double, 2, 3>;  // value and velocity of each coordinate; they share their covariance
using Eigen::Matrix2d;
using Eigen::Vector2d;

// The process over one step of time.
struct Transition {
  Matrix2d F;
  Matrix2d Q;
};

Transition transition(double lambda, const Matrix2d& P_rest, double dt_s) {
  Transition step;
  step.F << 1.0 + lambda * dt_s, dt_s, -lambda * lambda * dt_s, 1.0 - lambda * dt_s;
  step.F *= std::exp(-lambda * dt_s);
  step.Q = P_rest - step.F * P_rest * step.F.transpose();
  return step;
}

struct Filtered {
  State predicted, x;
  Matrix2d P_predicted, P;
};

}  // namespace

double markerNoise(const Eigen::Matrix3Xd& p, const SeenFrames& seen) {
  // The third difference of white noise has sqrt(1 + 9 + 9 + 1) times its deviation.
  const double share = std::sqrt(20.0);
  constexpr double kDeviationPerMedian = 1.4826;  // of the size of a normal variable
  std::vector<double> sizes;
  for (Eigen::Index t = 3; t < p.cols(); ++t) {
    if (!seen[t] || !seen[t - 1] || !seen[t - 2] || !seen[t - 3]) continue;
    const Eigen::Vector3d third = p.col(t) - 3.0 * p.col(t - 1) + 3.0 * p.col(t - 2) - p.col(t - 3);
    for (const double size : third) sizes.push_back(std::abs(size));
  }
  if (sizes.size() < 24) return kLeastNoise_m;
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return std::max(kLeastNoise_m, kDeviationPerMedian * *middle / share);
}

Eigen::Matrix3Xd steadied(const Eigen::Matrix3Xd& p, const SeenFrames& seen, const std::vector<double>& time_s,
                          const SteadyConfig& config) {
  const double lambda = std::sqrt(3.0) / config.time_s;
  const double variance = config.deviation_m * config.deviation_m;
  const Matrix2d P_rest = Vector2d(variance, lambda * lambda * variance).asDiagonal();
  std::vector<Filtered> filtered(time_s.size());
  std::vector<Transition> steps(time_s.size());
  for (std::size_t t = 0; t < time_s.size(); ++t) {
    Filtered& now = filtered[t];
    if (t == 0) {
      now.predicted.setZero();
      now.P_predicted = P_rest;
    } else {
      steps[t] = transition(lambda, P_rest, time_s[t] - time_s[t - 1]);
      now.predicted = steps[t].F * filtered[t - 1].x;
      now.P_predicted = steps[t].F * filtered[t - 1].P * steps[t].F.transpose() + steps[t].Q;
    }
    now.x = now.predicted;
    now.P = now.P_predicted;
    const auto column = static_cast<Eigen::Index>(t);
    if (!seen[column]) continue;
    const Vector2d gain = now.P.col(0) / (now.P(0, 0) + config.noise_m * config.noise_m);
    now.x += gain * (p.col(column).transpose() - now.predicted.row(0));
    now.P -= gain * now.P_predicted.row(0);
  }
  Eigen::Matrix3Xd result(3, p.cols());
  State x = State::Zero();
  for (std::size_t t = time_s.size(); t-- > 0;) {
    if (t + 1 == time_s.size()) {
      x = filtered[t].x;
    } else {
      const Filtered& next = filtered[t + 1];
      const Matrix2d back = filtered[t].P * steps[t + 1].F.transpose() * next.P_predicted.inverse();
      x = (filtered[t].x + back * (x - next.predicted)).eval();
    }
    result.col(static_cast<Eigen::Index>(t)) = x.row(0).transpose();
  }
  return result;
}

}  // namespace depthmocap
