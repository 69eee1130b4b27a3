#include "libtracker/ik/levenberg_marquardt.h"

#include <limits>

#include <gtest/gtest.h>

namespace depthmocap {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Rosenbrock's valley, whose minimum is (1, 1).
class Valley final : public LeastSquaresProblem {
 public:
  explicit Valley(double highest_x = kInfinity) : highest_x_(highest_x) {}
  [[nodiscard]] int parameters() const override { return 2; }
  [[nodiscard]] int residuals() const override { return 2; }
  void evaluate(const Eigen::VectorXd& x, Eigen::VectorXd& E, Eigen::MatrixXd* J) override {
    E = Eigen::Vector2d(10 * (x[1] - x[0] * x[0]), 1 - x[0]);
    if (J != nullptr) *J = (Eigen::Matrix2d() << -20 * x[0], 10, -1, 0).finished();
  }
  [[nodiscard]] Eigen::VectorXd lower() const override { return Eigen::Vector2d(-kInfinity, -kInfinity); }
  [[nodiscard]] Eigen::VectorXd upper() const override { return Eigen::Vector2d(highest_x_, kInfinity); }

 private:
  double highest_x_;
};

TEST(LevenbergMarquardt, FindsTheEndOfTheValley) {
  Valley problem;
  Eigen::VectorXd x = Eigen::Vector2d(-1.2, 1);
  const LmSummary summary = levenbergMarquardt(problem, {}, x);
  EXPECT_NEAR(x[0], 1, 1e-5);
  EXPECT_NEAR(x[1], 1, 1e-5);
  EXPECT_LT(summary.energy, 1e-9);
  EXPECT_LT(summary.iterations, 60);
}

TEST(LevenbergMarquardt, StaysWithinBoundsAndFindsTheMinimumThere) {
  Valley problem(0.5);
  Eigen::VectorXd x = Eigen::Vector2d(2, 3);
  levenbergMarquardt(problem, {}, x);
  EXPECT_EQ(x[0], 0.5);
  EXPECT_NEAR(x[1], 0.25, 1e-5);
}

TEST(LevenbergMarquardt, StopsAfterTheIterationsAllowed) {
  Valley problem;
  Eigen::VectorXd x = Eigen::Vector2d(-1.2, 1);
  LmConfig config;
  config.max_iterations = 3;
  EXPECT_EQ(levenbergMarquardt(problem, config, x).iterations, 3);
}

}  // namespace
}  // namespace depthmocap
