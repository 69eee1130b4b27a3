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
// step takes beyond a bound ends there. It can stop in between and go on, so that several starts may race.
class LevenbergMarquardt {
 public:
  // The problem must outlive it. `start` is moved within the bounds first.
  LevenbergMarquardt(LeastSquaresProblem& problem, const Eigen::VectorXd& start);
  // Goes on until it is done or has tried so many steps in all.
  void run(int max_iterations);

  [[nodiscard]] const Eigen::VectorXd& x() const { return x_; }
  [[nodiscard]] const LmSummary& summary() const { return summary_; }

 private:
  // The quadratic model about x: A = J^T J, g = J^T E.
  struct Model {
    Eigen::MatrixXd A;
    Eigen::VectorXd g;
    void build(const Eigen::MatrixXd& J, const Eigen::VectorXd& E);
    // What the model says that a step lowers 1/2 |E|^2 by.
    [[nodiscard]] double gainOf(const Eigen::VectorXd& step) const;
  };

  // Tries one step; false where nothing is left to do.
  bool step();
  // -(A + mu I)^-1 g over the parameters that may move; 0 for the others.
  [[nodiscard]] Eigen::VectorXd dampedStep() const;

  LeastSquaresProblem* problem_;
  Eigen::VectorXd lower_;
  Eigen::VectorXd upper_;
  Eigen::VectorXd x_;
  Eigen::VectorXd E_;
  Eigen::VectorXd E_new_;
  Eigen::MatrixXd J_;
  Model model_;
  double mu_ = 0;
  double nu_ = 2;
  bool done_ = false;
  LmSummary summary_;
};

// From start to end. x: the start, moved within the bounds first; then the result.
LmSummary levenbergMarquardt(LeastSquaresProblem& problem, const LmConfig& config, Eigen::VectorXd& x);

}  // namespace depthmocap
