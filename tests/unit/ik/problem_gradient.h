#pragma once
#include <cmath>

#include "tests/gradient_check.h"

namespace depthmocap {

// The Jacobian of a LeastSquaresProblem at x against central differences; every entry must be written.
template <typename Problem>
void expectGradient(Problem& problem, const Eigen::VectorXd& x, double tolerance, double step) {
  const auto residual = [&](const Eigen::VectorXd& at) {
    Eigen::VectorXd E(problem.residuals());
    problem.evaluate(at, E, nullptr);
    return E;
  };
  const auto jacobian = [&](const Eigen::VectorXd& at) {
    Eigen::VectorXd E(problem.residuals());
    Eigen::MatrixXd J(problem.residuals(), problem.parameters());
    J.setConstant(std::nan(""));
    problem.evaluate(at, E, &J);
    return J;
  };
  expectJacobianMatches(x, residual, jacobian, tolerance, step);
}

}  // namespace depthmocap
