#pragma once
#include <Eigen/Core>

#include "depthmocap/pose.h"

namespace depthmocap {

// Rows of the stacked residual vector and of its Jacobian (columns = DoFs of q) that one term of equation (5) fills.
// Every term writes all of its rows each time, zero where it has nothing to say, so that the number of rows never
// changes. The energy of a term is the sum of its squared residuals, lambda included.
using ResidualRows = Eigen::Ref<Eigen::VectorXd>;
using JacobianRows = Eigen::Ref<Eigen::Matrix<double, Eigen::Dynamic, kDofCount>, 0, Eigen::OuterStride<>>;

}  // namespace depthmocap
