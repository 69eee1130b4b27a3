#include "libtracker/solve/map_solver.h"

#include <ceres/ceres.h>
#include <ceres/tiny_solver.h>
#include <fmt/format.h>

#include "depthmocap/error.h"
#include "libtracker/core/check.h"
#include "libtracker/solve/map_function.h"

namespace depthmocap {
namespace {

// MapFunction as a cost function of the general solver, which wants its Jacobian row-major.
class MapCost : public ceres::SizedCostFunction<MapFunction::NUM_RESIDUALS, kDofCount> {
 public:
  explicit MapCost(const MapFunction& function) : function_(function) {}
  bool Evaluate(const double* const* parameters, double* residuals, double** jacobians) const override {
    const bool wants_jacobian = jacobians != nullptr && jacobians[0] != nullptr;
    using Matrix = Eigen::Matrix<double, MapFunction::NUM_RESIDUALS, kDofCount>;
    Matrix J;
    if (!function_(parameters[0], residuals, wants_jacobian ? J.data() : nullptr)) return false;
    using RowMajor = Eigen::Matrix<double, MapFunction::NUM_RESIDUALS, kDofCount, Eigen::RowMajor>;
    if (wants_jacobian) Eigen::Map<RowMajor>{jacobians[0]} = J;
    return true;
  }

 private:
  const MapFunction& function_;
};

}  // namespace

std::vector<ConfigField> MapConfig::fields() {
  return {
      {"lambda_prior", &lambda_prior, "", atLeast(0), "Weight of the prior in equation (5), lambda1"},
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

struct MapSolver::Impl {
  MapConfig config;
  ceres::TinySolver<MapFunction> solver;
};

MapSolver::MapSolver(const MapConfig& config) : impl_(std::make_unique<Impl>()) {
  config.validate();
  impl_->config = config;
}
MapSolver::~MapSolver() = default;
MapSolver::MapSolver(MapSolver&&) noexcept = default;

MapSummary MapSolver::solve(const MapInput& input, Pose& q) {
  DMC_CHECK(q.allFinite());
  const MapFunction function(input, impl_->config);
  auto& solver = impl_->solver;
  // TinySolver counts the evaluation at the start as its first iteration.
  solver.options.max_num_iterations = impl_->config.max_iterations + 1;
  solver.options.function_tolerance = impl_->config.energy_tolerance;
  solver.Solve(function, &q);
  q[kRootRy] = wrappedAngle(q[kRootRy]);
  MapSummary summary;
  summary.converged = solver.summary.status != ceres::TinySolver<MapFunction>::HIT_MAX_ITERATIONS;
  summary.iterations = std::min(solver.summary.iterations, impl_->config.max_iterations);
  function.summarise(q, summary);
  return summary;
}

MapSummary MapSolver::solveReference(const MapInput& input, Pose& q) const {
  DMC_CHECK(q.allFinite());
  const MapFunction function(input, impl_->config);
  MapCost cost(function);
  ceres::Problem::Options ownership;
  ownership.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(ownership);
  problem.AddResidualBlock(&cost, nullptr, q.data());
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.logging_type = ceres::SILENT;
  options.max_num_iterations = 500;
  options.function_tolerance = 1e-12;
  options.parameter_tolerance = 1e-10;
  ceres::Solver::Summary report;
  ceres::Solve(options, &problem, &report);
  q[kRootRy] = wrappedAngle(q[kRootRy]);
  MapSummary summary;
  summary.converged = report.termination_type == ceres::CONVERGENCE;
  summary.iterations = static_cast<int>(report.iterations.size()) - 1;
  function.summarise(q, summary);
  return summary;
}

}  // namespace depthmocap
