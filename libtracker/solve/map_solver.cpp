#include "libtracker/solve/map_solver.h"

#include <algorithm>
#include <cmath>

#include <ceres/ceres.h>

#include "depthmocap/error.h"
#include "libtracker/core/check.h"
#include "libtracker/solve/map_energy.h"

namespace depthmocap {
namespace {

constexpr double kFirstDamping = 1e-4;    // times the diagonal: the first step is nearly that of Gauss-Newton
constexpr double kLeastCurvature = 1e-6;  // damps a DoF that nothing holds
constexpr double kFlat = 1e-10;           // [energy/m, energy/rad] the largest slope of a minimum
constexpr double kShortStep = 1e-8;       // share of |q|: no step shorter than this is tried again

// For the general solver.
class EnergyFunction : public ceres::FirstOrderFunction {
 public:
  explicit EnergyFunction(MapEnergy& energy) : energy_(energy) {}
  [[nodiscard]] int NumParameters() const override { return kDofCount; }
  bool Evaluate(const double* parameters, double* cost, double* gradient) const override {
    const Pose q = Eigen::Map<const Pose>(parameters);
    NormalEquations equations;
    energy_.expand(energy_.at(q), equations);
    *cost = equations.energy;
    if (gradient != nullptr) Eigen::Map<Pose>{gradient} = 2.0 * equations.g;
    return true;
  }

 private:
  MapEnergy& energy_;
};

}  // namespace

std::vector<ConfigField> MapConfig::fields() {
  return {
      {"lambda_prior", &lambda_prior, "", atLeast(0), "Weight of the prior in equation (5), lambda1"},
      {"prior_freedom", &prior_freedom, "", atLeast(0), "Degrees of freedom of the prior as a Student distribution"},
      {"lambda_marker", &lambda_marker, "", above(0), "Weight of the markers in equation (5), lambda2"},
      {"lambda_smooth", &lambda_smooth, "", atLeast(0), "Weight of smoothness in equation (5), lambda3"},
      {"lambda_limit", &lambda_limit, "", atLeast(0), "Weight of the joint limits"},
      {"lambda_surface", &lambda_surface, "", atLeast(0), "Weight of one match of the dense term"},
      {"sigma_surface_m", &sigma_surface_m, "m", above(0), "Scale of the dense term"},
      {"lambda_contact", &lambda_contact, "", atLeast(0), "Weight of a foot that stands"},
      {"sigma_contact_m", &sigma_contact_m, "m", above(0), "Scale of the Lorentzian of a foot that stands"},
      {"velocity_share", &velocity_share, "", fromTo(0, 1), "Share of the last velocity that is expected to go on"},
      {"sigma_m", &sigma_m, "m", above(0), "Scale of the Lorentzian of the markers"},
      {"max_iterations", &max_iterations, "", atLeast(1), "Steps of one solve"},
      {"energy_tolerance", &energy_tolerance, "", above(0), "A solve ends where one step changes the energy by less"},
  };
}

void MapConfig::validate() const {
  checkFieldsOf("MapConfig", *this);
}

MapSolver::MapSolver(const MapConfig& config) : config_(config) {
  config_.validate();
}

// Levenberg-Marquardt with the damping of Nielsen 1999, on the diagonal of A (Marquardt 1963).
MapSummary MapSolver::solve(const MapInput& input, Pose& q, int most_steps) {
  DMC_CHECK(q.allFinite());
  MapEnergy energy(input, config_);
  MapSummary summary;
  energy.expand(energy.at(q), equations_);
  double mu = kFirstDamping;
  double growth = 2.0;
  while (!summary.converged && summary.iterations < config_.max_iterations) {
    if (equations_.g.cwiseAbs().maxCoeff() < kFlat) {
      summary.converged = true;
      break;
    }
    ++summary.iterations;
    const Pose damping = mu * equations_.A.diagonal().cwiseMax(kLeastCurvature);
    ldlt_.compute(PoseMatrix(equations_.A + damping.asDiagonal().toDenseMatrix()));
    const Pose step = ldlt_.solve(-equations_.g);
    const Pose q_new = q + step;
    const double energy_new = energy.at(q_new);
    const double gain = equations_.energy - energy_new;
    if (!(gain > 0)) {
      summary.converged = step.norm() < kShortStep * (q.norm() + kShortStep);
      mu *= growth;
      growth *= 2.0;
      continue;
    }
    q = q_new;
    summary.converged = gain < config_.energy_tolerance;
    if (summary.converged || --most_steps == 0) break;
    // What the model promised: its decrease for the damped step.
    const double promised = step.dot(damping.cwiseProduct(step)) - step.dot(equations_.g);
    mu *= std::max(1.0 / 3.0, 1.0 - std::pow(2.0 * gain / promised - 1.0, 3));
    growth = 2.0;
    energy.expand(energy_new, equations_);
  }
  q[kRootRy] = wrappedAngle(q[kRootRy]);
  energy.summarise(q, summary);
  return summary;
}

void MapSolver::expandEvidence(MapInput input, const Pose& q, NormalEquations& evidence) const {
  input.q_prev = nullptr;
  MapEnergy energy(input, config_);
  energy.expand(energy.at(q), evidence);
}

MapSummary MapSolver::solveReference(const MapInput& input, Pose& q) const {
  DMC_CHECK(q.allFinite());
  MapEnergy energy(input, config_);
  const ceres::GradientProblem problem(new EnergyFunction(energy));  // takes it over
  ceres::GradientProblemSolver::Options options;
  options.logging_type = ceres::SILENT;
  options.max_num_iterations = 5000;
  options.function_tolerance = 1e-15;
  options.gradient_tolerance = 1e-9;
  options.parameter_tolerance = 1e-12;
  ceres::GradientProblemSolver::Summary report;
  ceres::Solve(options, problem, q.data(), &report);
  q[kRootRy] = wrappedAngle(q[kRootRy]);
  MapSummary summary;
  summary.converged = report.termination_type == ceres::CONVERGENCE;
  summary.iterations = static_cast<int>(report.iterations.size()) - 1;
  energy.summarise(q, summary);
  return summary;
}

}  // namespace depthmocap
