#include "libtracker/solve/robust_pull.h"

#include <algorithm>
#include <cmath>

namespace depthmocap {

RobustPull robustPull(const Eigen::Vector3d& e, double sigma_m, double weight) {
  const double x = e.squaredNorm();
  const double per_x = 1.0 / (2.0 * sigma_m * sigma_m);
  const double u = x * per_x;
  // g(u) = log(1 + u) / u and its derivative; the series near 0, where the quotients cancel.
  const bool small = u < 1e-4;
  const double g = small ? 1.0 - u / 2.0 + u * u / 3.0 : std::log1p(u) / u;
  const double dg = small ? -0.5 + 2.0 * u / 3.0 - 0.75 * u * u : (u / (1.0 + u) - std::log1p(u)) / (u * u);
  const double s = std::sqrt(per_x * g);                  // sqrt(rho / x)
  const double slope = per_x * per_x * dg / (2.0 * s);    // ds / dx
  const double drho = per_x / (1.0 + u);                  // d rho / dx
  const double missing = drho - (drho * drho) / (s * s);  // curvature that r lacks along e
  const double root = std::sqrt(weight);
  return {root * s * e, root * (s * Eigen::Matrix3d::Identity() + 2.0 * slope * e * e.transpose()),
          root * std::sqrt(std::max(0.0, missing)) * e.normalized().transpose()};
}

}  // namespace depthmocap
