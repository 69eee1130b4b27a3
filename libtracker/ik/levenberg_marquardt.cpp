#include "libtracker/ik/levenberg_marquardt.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace depthmocap {
namespace {

// First damping over the largest diagonal entry of J^T J; chosen by hand.
constexpr double kFirstDamping = 1e-3;
// The solve stops at a shorter step (epsilon_2 of the method).
constexpr double kStepTolerance = 1e-7;
// The solve stops where a step lowers |E|^2 by a smaller share.
constexpr double kGainTolerance = 1e-5;

using Eigen::MatrixXd;
using Eigen::VectorXd;

}  // namespace

void LevenbergMarquardt::Model::build(const MatrixXd& J, const VectorXd& E) {
  A.setZero(J.cols(), J.cols());
  A.selfadjointView<Eigen::Lower>().rankUpdate(J.transpose());
  A.triangularView<Eigen::StrictlyUpper>() = A.transpose();
  g.noalias() = J.transpose() * E;
}

double LevenbergMarquardt::Model::gainOf(const VectorXd& step) const {
  return -step.dot(g) - 0.5 * step.dot(A * step);
}

LevenbergMarquardt::LevenbergMarquardt(LeastSquaresProblem& problem, const VectorXd& start)
    : problem_(&problem),
      lower_(problem.lower()),
      upper_(problem.upper()),
      x_(start.cwiseMax(lower_).cwiseMin(upper_)),
      E_(problem.residuals()),
      E_new_(problem.residuals()),
      J_(problem.residuals(), problem.parameters()) {
  problem_->evaluate(x_, E_, &J_);
  summary_.energy = 0.5 * E_.squaredNorm();
  model_.build(J_, E_);
  mu_ = kFirstDamping * std::max(1e-12, model_.A.diagonal().maxCoeff());
}

VectorXd LevenbergMarquardt::dampedStep() const {
  MatrixXd damped = model_.A;
  VectorXd g = model_.g;
  for (Eigen::Index i = 0; i < x_.size(); ++i) {
    const bool rests = (x_[i] <= lower_[i] && g[i] > 0) || (x_[i] >= upper_[i] && g[i] < 0);
    if (rests) {
      damped.row(i).setZero();
      damped.col(i).setZero();
      g[i] = 0;
      damped(i, i) = 1;
    }
    damped(i, i) += mu_;
  }
  return -damped.llt().solve(g);
}

bool LevenbergMarquardt::step() {
  const VectorXd x_new = (x_ + dampedStep()).cwiseMax(lower_).cwiseMin(upper_);
  const VectorXd step = x_new - x_;
  if (!(step.norm() > kStepTolerance)) return false;  // also where the numbers left the range of double
  problem_->evaluate(x_new, E_new_, nullptr);
  const double gain = summary_.energy - 0.5 * E_new_.squaredNorm();
  const double rho = gain / std::max(model_.gainOf(step), 1e-300);
  if (!(rho > 0)) {
    mu_ *= nu_;
    nu_ *= 2.0;
    return true;
  }
  x_ = x_new;
  const bool is_done = gain <= kGainTolerance * summary_.energy;
  summary_.energy -= gain;
  if (is_done) return false;
  problem_->evaluate(x_, E_, &J_);
  model_.build(J_, E_);
  mu_ *= std::max(1.0 / 3.0, 1.0 - std::pow(2.0 * rho - 1.0, 3));
  nu_ = 2.0;
  return true;
}

void LevenbergMarquardt::run(int max_iterations) {
  while (!done_ && summary_.iterations < max_iterations) {
    ++summary_.iterations;
    done_ = !step();
  }
}

LmSummary levenbergMarquardt(LeastSquaresProblem& problem, const LmConfig& config, VectorXd& x) {
  LevenbergMarquardt solve(problem, x);
  solve.run(config.max_iterations);
  x = solve.x();
  return solve.summary();
}

}  // namespace depthmocap
