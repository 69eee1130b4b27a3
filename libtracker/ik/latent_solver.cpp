#include "libtracker/ik/latent_solver.h"

#include <limits>

#include "libtracker/ik/latent_problem.h"
#include "libtracker/skeleton/joint_limits.h"

namespace depthmocap {

IkResult LatentSolver::solve(const std::vector<Pose>& starts, const LmConfig& config, TargetTerm& targets) const {
  LatentProblem problem(scale_, coder_, targets);
  IkResult best;
  double least = std::numeric_limits<double>::max();
  for (const Pose& start : starts) {
    Eigen::VectorXd x = problem.encoded(start);
    const LmSummary summary = levenbergMarquardt(problem, config, x);
    best.iterations += summary.iterations;
    if (!(summary.energy < least)) continue;
    least = summary.energy;
    best.q = clampedToLimits(problem.decoded(x));
  }
  best.residual_m = targets.rms(best.q);
  return best;
}

}  // namespace depthmocap
