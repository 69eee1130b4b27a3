#include "libtracker/solve/robust_pull.h"

#include <cmath>

namespace depthmocap {

RobustPull robustPull(double square_m2, double sigma_m, double weight) {
  const double per_square = 1.0 / (2.0 * sigma_m * sigma_m);
  const double u = square_m2 * per_square;
  return {weight * std::log1p(u), weight * per_square / (1.0 + u)};
}

}  // namespace depthmocap
