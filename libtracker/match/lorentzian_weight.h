#pragma once

namespace depthmocap {

// Weight (0, 1] of a match whose point is `off_m` [m] off the surface: Lorentzian of width `sigma_m` [m] (> 0).
inline double lorentzianWeight(double off_m, double sigma_m) {
  return 1.0 / (1.0 + off_m * off_m / (2.0 * sigma_m * sigma_m));
}

}  // namespace depthmocap
