#include "libtracker/solve/map_solver.h"

#include <ceres/ceres.h>
#include <ceres/tiny_solver.h>
#include <fmt/format.h>

#include "depthmocap/error.h"
#include "libtracker/core/check.h"
#include "libtracker/solve/map_function.h"

namespace depthmocap {
namespace {

void require(bool holds, const char* field, double value, const char* rule) {
  if (!holds) throw Error(fmt::format("{} = {}, but it must be {}", field, value, rule), "MAP solver settings");
}

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

void MapConfig::validate() const {
  require(lambda_prior >= 0, "lambda_prior", lambda_prior, "at least 0");
  require(lambda_marker > 0, "lambda_marker", lambda_marker, "above 0");
  require(lambda_smooth >= 0, "lambda_smooth", lambda_smooth, "at least 0");
  require(lambda_limit >= 0, "lambda_limit", lambda_limit, "at least 0");
  require(lambda_surface >= 0, "lambda_surface", lambda_surface, "at least 0");
  require(sigma_surface_m > 0, "sigma_surface_m", sigma_surface_m, "above 0");
  require(lambda_contact >= 0, "lambda_contact", lambda_contact, "at least 0");
  require(sigma_contact_m > 0, "sigma_contact_m", sigma_contact_m, "above 0");
  require(velocity_share >= 0 && velocity_share <= 1, "velocity_share", velocity_share, "from 0 to 1");
  require(sigma_m > 0, "sigma_m", sigma_m, "above 0");
  require(max_iterations >= 1, "max_iterations", max_iterations, "at least 1");
  require(energy_tolerance > 0, "energy_tolerance", energy_tolerance, "above 0");
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
