#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace depthmocap {

// Compares an analytic Jacobian with central differences, entry by entry.
//
// residual: VectorXd(const VectorXd& x); jacobian: MatrixXd(const VectorXd& x), rows as residual(x), columns as x.
// An entry fails where |analytic - numeric| > tolerance * max(1, |numeric|). The step suits values of order one: its
// error is about step^2 * third derivative + 1e-16 / step.
template <typename Residual, typename Jacobian>
void expectJacobianMatches(const Eigen::VectorXd& x, const Residual& residual, const Jacobian& jacobian,
                           double tolerance = 1e-6, double step = 1e-5) {
  const Eigen::MatrixXd analytic = jacobian(x);
  const Eigen::VectorXd value = residual(x);
  ASSERT_EQ(analytic.rows(), value.size());
  ASSERT_EQ(analytic.cols(), x.size());
  for (Eigen::Index column = 0; column < x.size(); ++column) {
    Eigen::VectorXd above = x;
    Eigen::VectorXd below = x;
    above[column] += step;
    below[column] -= step;
    const Eigen::VectorXd numeric = (residual(above) - residual(below)) / (2.0 * step);
    for (Eigen::Index row = 0; row < value.size(); ++row) {
      const double allowed = tolerance * std::max(1.0, std::abs(numeric[row]));
      EXPECT_NEAR(analytic(row, column), numeric[row], allowed) << "row " << row << ", column " << column;
    }
  }
}

}  // namespace depthmocap
