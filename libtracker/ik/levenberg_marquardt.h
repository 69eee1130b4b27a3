#pragma once
#include <Eigen/Core>

namespace depthmocap {

// A problem min 1/2 |E(x)|^2 with lower <= x <= upper.
class LeastSquaresProblem {
 public:
  LeastSquaresProblem() = default;
  virtual ~LeastSquaresProblem() = default;
  LeastSquaresProblem(const LeastSquaresProblem&) = delete;
  LeastSquaresProblem& operator=(const LeastSquaresProblem&) = delete;

  [[nodiscard]] virtual int parameters() const = 0;
  [[nodiscard]] virtual int residuals() const = 0;
  // E: residuals(); J: residuals() x parameters(), d E / d x, or nullptr.
  virtual void evaluate(const Eigen::VectorXd& x, Eigen::VectorXd& E, Eigen::MatrixXd* J) = 0;
  // Infinite where there is no bound.
  [[nodiscard]] virtual Eigen::VectorXd lower() const = 0;
  [[nodiscard]] virtual Eigen::VectorXd upper() const = 0;
};

struct LmConfig {
  int max_iterations = 60;  // (>= 1) steps tried
};

struct LmSummary {
  double energy = 0;   // 1/2 |E|^2
  int iterations = 0;  // steps tried
};

// Algorithm 1 of MNN-IK (Hu, Zhang, Xia 2021): Levenberg-Marquardt with the damping of Nielsen as Lourakis 2005 gives
// it. Beyond the paper: bounds. A parameter at its bound that the gradient pushes outwards rests for the step; what a
// step takes beyond a bound ends there. x: the start, moved within the bounds first; then the result.
LmSummary levenbergMarquardt(LeastSquaresProblem& problem, const LmConfig& config, Eigen::VectorXd& x);

}  // namespace depthmocap
