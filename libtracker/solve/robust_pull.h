#pragma once
#include <Eigen/Core>

namespace depthmocap {

// A pull on a point that stands off by e [m], as rows of a least-squares problem: weight * rho(|e|), rho(e) = log(1 +
// e^2 / (2 sigma^2)) the Lorentzian.
//
// r = sqrt(weight * rho(|e|) / |e|^2) e, so that |r|^2 is exactly that. Its Jacobian lacks curvature: sqrt(rho) is
// concave, and Gauss-Newton on r alone overshoots a point that is further than sigma away (by 2.4 times at 4 sigma). A
// row more, whose residual is always 0 and whose "Jacobian" is `along`, raises the curvature along e to rho'(|e|^2),
// that of iteratively reweighted least squares, whose quadratic model lies above rho everywhere. Energy and gradient
// stay exact.
struct RobustPull {
  Eigen::Vector3d r;
  Eigen::Matrix3d dr_de;
  Eigen::RowVector3d along;
};

// weight >= 0, sigma_m [m] > 0.
RobustPull robustPull(const Eigen::Vector3d& e, double sigma_m, double weight);

}  // namespace depthmocap
