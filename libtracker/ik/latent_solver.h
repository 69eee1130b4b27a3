#pragma once
#include <vector>

#include "depthmocap/ik_result.h"
#include "libtracker/ik/learned_poses.h"
#include "libtracker/ik/levenberg_marquardt.h"
#include "libtracker/ik/target_term.h"

namespace depthmocap {

// Latent IK (VPoser, Pavlakos et al. 2019): only poses are sought that the variational decoder can make. Minimises
// |f(q(z)) - c|^2 + weight^2 |z|^2 over the code z, the place and the heading. Theirs takes 100 steps along the
// gradient, ours those of Levenberg-Marquardt with analytic Jacobians through body and decoder. Constant after
// construction: threads may share one. Deterministic.
class LatentSolver {
 public:
  LatentSolver(const PoseScale& scale, const PoseCoder& variational) : scale_(scale), coder_(variational) {}

  // The best of what is found from each start (at least one), by its code, within joint limits.
  [[nodiscard]] IkResult solve(const std::vector<Pose>& starts, const LmConfig& config, TargetTerm& targets) const;

 private:
  PoseScale scale_;
  FastPoseCoder coder_;
};

}  // namespace depthmocap
