#pragma once
#include <Eigen/Cholesky>
#include <limits>
#include <vector>

#include "depthmocap/marker_set.h"
#include "libtracker/core/config_fields.h"
#include "libtracker/skeleton/local_prior.h"
#include "libtracker/skeleton/marker_model.h"
#include "libtracker/skeleton/normal_equations.h"
#include "libtracker/skeleton/skeleton.h"
#include "libtracker/skeleton/surface_match.h"
#include "libtracker/solve/contact_term.h"

namespace depthmocap {

// Weights and limits of the MAP solve, equation (5). Energies mix m^2 and rad^2 as the paper does.
struct MapConfig {
  double lambda_prior = 0.2;       // (>= 0) lambda1
  double prior_freedom = 0.0;      // (>= 0) of the prior as a Student distribution, beyond the paper; 0 = a Gaussian
  double lambda_marker = 5.0;      // (> 0) lambda2
  double lambda_smooth = 1.0;      // (>= 0) lambda3
  double lambda_limit = 10.0;      // (>= 0) joint limits, beyond the paper; 0 = none
  double lambda_surface = 0.5;     // (>= 0) a match of the dense term, beyond the paper; 0 = none
  double sigma_surface_m = 0.03;   // [m] (> 0) of the dense term
  double lambda_contact = 5.0;     // (>= 0) a foot that stands, beyond the paper; 0 = none
  double sigma_contact_m = 0.02;   // [m] (> 0) of its Lorentzian
  double velocity_share = 1.0;     // (0 .. 1) share of the last velocity that E_smooth expects to go on; 1: the paper
  double sigma_m = 0.05;           // [m] (> 0) of the Lorentzian
  int max_iterations = 20;         // (>= 1) a guard: the mean of a solve that may converge is about 6
  double energy_tolerance = 1e-3;  // (> 0) stop where one step changes the energy by less
  std::vector<ConfigField> fields();
  void validate() const;  // throws Error naming field, value and rule
};

// One frame's problem. The references must outlive solve().
struct MapInput {
  const Skeleton& skeleton;
  const MarkerModel& markers;
  const MarkerSet& markers_world;     // what was seen [m], y up
  const LocalPrior* prior = nullptr;  // nullptr: no prior term
  // The poses before, in the world; both: constant velocity is expected; q_prev alone: no motion; none: no smooth term.
  const Pose* q_prev = nullptr;
  const Pose* q_prev2 = nullptr;
  const SurfaceMatches* surface = nullptr;  // nullptr: no dense term
  const FootContacts* contacts = nullptr;   // nullptr: no foot stands
};

// Result of a solve. e_*: the terms of (5) without their lambda, at the result.
struct MapSummary {
  double energy = 0;        // lambda-weighted sum of all terms
  double e_marker = 0;      // confidence-weighted
  double e_prior = 0;       // [rad^2]
  double e_smooth = 0;      // [m^2 + rad^2]
  double e_limit = 0;       // [rad^2]
  double e_surface = 0;     // squared distances over 2 sigma^2
  double e_contact = 0;     // of the feet that stand
  double rms_marker_m = 0;  // [m] confidence-weighted distance of the seen markers; 0 if none
  int iterations = 0;       // Levenberg-Marquardt steps tried
  bool converged = false;   // false: max_iterations came first
};

// Minimises equation (5) by Levenberg-Marquardt on normal equations that are summed in the kinematic tree
// (TwistEquations). Thread-compatible; solve() does not allocate.
class MapSolver {
 public:
  explicit MapSolver(const MapConfig& config);  // throws as MapConfig::validate

  // q: where to start, then the result; world frame, heading in (-pi, pi]. Ends after max_iterations, or `most_steps`
  // that lower the energy.
  MapSummary solve(const MapInput& input, Pose& q, int most_steps = std::numeric_limits<int>::max());
  // What the frame says of its pose by itself: equation (5) at q without its smoothness.
  void expandEvidence(MapInput input, const Pose& q, NormalEquations& evidence) const;
  // The same minimum by Ceres' L-BFGS, from energies and gradients alone: slow, the reference of solve().
  MapSummary solveReference(const MapInput& input, Pose& q) const;

 private:
  MapConfig config_;
  NormalEquations equations_;
  Eigen::LDLT<PoseMatrix> ldlt_;
};

}  // namespace depthmocap
