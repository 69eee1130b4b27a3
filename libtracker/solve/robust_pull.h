#pragma once

namespace depthmocap {

// A pull on a point that stands off by e [m]: weight * rho(|e|), rho(e) = log(1 + e^2 / (2 sigma^2)) the Lorentzian.
//
// Its quadratic model is that of iteratively reweighted least squares, k |e|^2 with k = weight * d rho / d |e|^2: the
// gradient is exact, and the model lies above rho everywhere, so that a step never overshoots a point that is further
// than sigma away.
struct RobustPull {
  double energy = 0;
  double k = 0;  // [1/m^2]
};

// square_m2: |e|^2 [m^2]; sigma_m [m] > 0; weight >= 0.
RobustPull robustPull(double square_m2, double sigma_m, double weight);

}  // namespace depthmocap
