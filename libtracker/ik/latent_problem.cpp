#include "libtracker/ik/latent_problem.h"

#include <array>
#include <limits>

namespace depthmocap {
namespace {

// [m] that one unit of the code is worth; the blog on latent IK has 0.0316 (1e-3 |z|^2). Of 0.0003 to 0.0316 the best
// on motions that neither priors nor measurements use (docs/lab/ik.md).
constexpr double kCodeWeight_m = 0.003;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

constexpr std::array<int, 4> kFreeDofs = {kRootTx, kRootTy, kRootTz, kRootRy};

}  // namespace

Eigen::VectorXd LatentProblem::lower() const {
  return Eigen::VectorXd::Constant(parameters(), -kInfinity);
}

Eigen::VectorXd LatentProblem::upper() const {
  return Eigen::VectorXd::Constant(parameters(), kInfinity);
}

Eigen::VectorXd LatentProblem::encoded(const Pose& q) const {
  Eigen::VectorXd x(parameters());
  for (int i = 0; i < kFreeCount; ++i) x[i] = q[kFreeDofs[static_cast<std::size_t>(i)]];
  x.tail(code()) = coder_.encoder.evaluate(scale_.scaled(shapeOf(q))).head(code()).cast<double>();
  return x;
}

Pose LatentProblem::decoded(const Eigen::VectorXd& x, Eigen::MatrixXf* J_decoder) const {
  Pose q = Pose::Zero();
  for (int i = 0; i < kFreeCount; ++i) q[kFreeDofs[static_cast<std::size_t>(i)]] = x[i];
  return withShape(q, scale_.unscaled(coder_.decoder.evaluate(x.tail(code()).cast<float>(), J_decoder)));
}

void LatentProblem::evaluate(const Eigen::VectorXd& x, Eigen::VectorXd& E, Eigen::MatrixXd* J) {
  Eigen::MatrixXf J_decoder;
  const Pose q = decoded(x, J == nullptr ? nullptr : &J_decoder);
  const int rows = targets_.rows();
  E.tail(code()) = kCodeWeight_m * x.tail(code());
  if (J == nullptr) return targets_.evaluate(q, E.head(rows), nullptr);
  Eigen::MatrixXd J_q(rows, kDofCount);
  RowsJacobian J_rows(J_q);
  targets_.evaluate(q, E.head(rows), &J_rows);
  Eigen::MatrixXd J_shape(rows, kShapeDofCount);
  for (int i = 0; i < kShapeDofCount; ++i) {
    J_shape.col(i) = scale_.deviation[i] * J_q.col(kShapeDofs[static_cast<std::size_t>(i)]);
  }
  J->setZero();
  for (int i = 0; i < kFreeCount; ++i) J->col(i).head(rows) = J_q.col(kFreeDofs[static_cast<std::size_t>(i)]);
  J->topRightCorner(rows, code()) = J_shape * J_decoder.cast<double>();
  J->bottomRightCorner(code(), code()).diagonal().setConstant(kCodeWeight_m);
}

}  // namespace depthmocap
