#pragma once
#include <Eigen/Core>
#include <vector>

#include "libtracker/marker_files/marker_sequence.h"

namespace depthmocap {

using SeenFrames = Eigen::Array<bool, Eigen::Dynamic, 1>;

// [m] Deviation of the noise of each coordinate of a track, from its third differences over frames in a row, which
// hardly see motion: their median, so that quick moments do not count. Nothing below kLeastNoise_m; that, too, where
// fewer than 8 such differences are seen.
double markerNoise(const Eigen::Matrix3Xd& p, const SeenFrames& seen);
inline constexpr double kLeastNoise_m = 0.0005;

// The smooth motion behind samples: a Gaussian process about 0 (Matern, nu = 3/2: a damped oscillator driven by white
// noise) seen with white noise, solved by a Kalman filter and its backward pass (Rauch, Tung, Striebel). Where nothing
// is seen the result runs on from what is seen before and after, and back to 0.
struct SteadyConfig {
  double deviation_m = 0.01;  // [m] (> 0) of the process
  double time_s = 0.3;        // [s] (> 0) over which it is correlated
  double noise_m = 0.001;     // [m] (> 0) of a sample
};
Eigen::Matrix3Xd steadied(const Eigen::Matrix3Xd& p, const SeenFrames& seen, const std::vector<double>& time_s,
                          const SteadyConfig& config);

}  // namespace depthmocap
