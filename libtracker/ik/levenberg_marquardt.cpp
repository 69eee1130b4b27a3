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

// The quadratic model about x: A = J^T J, g = J^T E.
struct Model {
  MatrixXd A;
  VectorXd g;

  void build(const MatrixXd& J, const VectorXd& E) {
    A.setZero(J.cols(), J.cols());
    A.selfadjointView<Eigen::Lower>().rankUpdate(J.transpose());
    A.triangularView<Eigen::StrictlyUpper>() = A.transpose();
    g.noalias() = J.transpose() * E;
  }
  // What the model says that a step lowers 1/2 |E|^2 by.
  [[nodiscard]] double gainOf(const VectorXd& step) const { return -step.dot(g) - 0.5 * step.dot(A * step); }
};

// -(A + mu I)^-1 g over the parameters that may move; 0 for the others.
VectorXd dampedStep(const Model& model, double mu, const VectorXd& x, const VectorXd& lower, const VectorXd& upper) {
  MatrixXd damped = model.A;
  VectorXd g = model.g;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const bool rests = (x[i] <= lower[i] && g[i] > 0) || (x[i] >= upper[i] && g[i] < 0);
    if (rests) {
      damped.row(i).setZero();
      damped.col(i).setZero();
      g[i] = 0;
      damped(i, i) = 1;
    }
    damped(i, i) += mu;
  }
  return -damped.llt().solve(g);
}

}  // namespace

LmSummary levenbergMarquardt(LeastSquaresProblem& problem, const LmConfig& config, VectorXd& x) {
  const VectorXd lower = problem.lower();
  const VectorXd upper = problem.upper();
  x = x.cwiseMax(lower).cwiseMin(upper);
  VectorXd E(problem.residuals());
  VectorXd E_new(problem.residuals());
  MatrixXd J(problem.residuals(), problem.parameters());
  problem.evaluate(x, E, &J);
  LmSummary summary;
  summary.energy = 0.5 * E.squaredNorm();
  Model model;
  model.build(J, E);
  double mu = kFirstDamping * std::max(1e-12, model.A.diagonal().maxCoeff());
  double nu = 2.0;
  while (summary.iterations < config.max_iterations) {
    ++summary.iterations;
    const VectorXd x_new = (x + dampedStep(model, mu, x, lower, upper)).cwiseMax(lower).cwiseMin(upper);
    const VectorXd step = x_new - x;
    if (!(step.norm() > kStepTolerance)) break;  // also where the numbers left the range of double
    problem.evaluate(x_new, E_new, nullptr);
    const double gain = summary.energy - 0.5 * E_new.squaredNorm();
    const double rho = gain / std::max(model.gainOf(step), 1e-300);
    if (!(rho > 0)) {
      mu *= nu;
      nu *= 2.0;
      continue;
    }
    x = x_new;
    const bool is_done = gain <= kGainTolerance * summary.energy;
    summary.energy -= gain;
    if (is_done) break;
    problem.evaluate(x, E, &J);
    model.build(J, E);
    mu *= std::max(1.0 / 3.0, 1.0 - std::pow(2.0 * rho - 1.0, 3));
    nu = 2.0;
  }
  return summary;
}

}  // namespace depthmocap
