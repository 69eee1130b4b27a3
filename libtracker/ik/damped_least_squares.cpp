#include <Eigen/Cholesky>
#include <algorithm>
#include <numbers>

#include "libtracker/ik/classic_solvers.h"
#include "libtracker/ik/closest_so_far.h"
#include "libtracker/ik/target_term.h"
#include "libtracker/skeleton/joint_limits.h"

namespace depthmocap {
namespace {

constexpr double kLambda2 = 0.05 * 0.05;  // [m^2] damping
constexpr double kLongestStep = 0.3;      // [rad] and [m] of one DoF in one step: the linear model holds no farther
constexpr int kMaxIterations = 200;

// A DoF at its limit that the targets push outwards rests for the step.
void rest(const Pose& q, const Eigen::VectorXd& e, Eigen::MatrixXd& J) {
  const JointLimits& limits = jointLimits();
  for (int i = kFirstBodyDof; i < kDofCount; ++i) {
    const double push = -J.col(i).dot(e);
    if ((q[i] <= limits.lower[i] && push < 0) || (q[i] >= limits.upper[i] && push > 0)) J.col(i).setZero();
  }
}

}  // namespace

IkResult solveDampedLeastSquares(const Skeleton& skeleton, const JointTargets& targets, const Pose& q) {
  TargetTerm term(skeleton, targets);
  Eigen::VectorXd e(term.rows());
  Eigen::MatrixXd J(term.rows(), kDofCount);
  RowsJacobian J_rows(J);
  ClosestSoFar closest(q, term.rms(q));
  Pose now = q;
  while (closest.goesOn(kMaxIterations)) {
    term.evaluate(now, e, &J_rows);
    rest(now, e, J);
    Eigen::MatrixXd JJt = J * J.transpose();
    JJt.diagonal().array() += kLambda2;
    Pose step = -J.transpose() * JJt.llt().solve(e);
    step *= std::min(1.0, kLongestStep / std::max(1e-12, step.tail<kDofCount - 3>().cwiseAbs().maxCoeff()));
    now = clampedToLimits(now + step);
    closest.add(now, term.rms(now));
  }
  return closest.result();
}

}  // namespace depthmocap
