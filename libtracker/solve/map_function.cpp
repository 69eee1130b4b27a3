#include "libtracker/solve/map_function.h"

namespace depthmocap {
namespace {

constexpr int kMarkerRow = 0;
constexpr int kPriorRow = kMarkerRow + MarkerTerm::kRows;
constexpr int kSmoothRow = kPriorRow + PriorTerm::kRows;
constexpr int kLimitRow = kSmoothRow + SmoothTerm::kRows;
constexpr int kSurfaceRow = kLimitRow + LimitTerm::kRows;
constexpr int kContactRow = kSurfaceRow + SurfaceTerm::kRows;
static_assert(kContactRow + ContactTerm::kRows == MapFunction::NUM_RESIDUALS);

using Residuals = Eigen::Matrix<double, MapFunction::NUM_RESIDUALS, 1>;
using Jacobian = Eigen::Matrix<double, MapFunction::NUM_RESIDUALS, kDofCount>;

template <typename Term>
void evaluateTerm(Term& term, int first_row, const Pose& q, Eigen::Map<Residuals>& r, double* jacobian) {
  const ResidualRows rows = r.segment(first_row, Term::kRows);
  if (jacobian == nullptr) {
    term.evaluate(q, rows, nullptr);
    return;
  }
  Eigen::Map<Jacobian> J(jacobian);
  JacobianRows J_rows = J.middleRows(first_row, Term::kRows);
  term.evaluate(q, rows, &J_rows);
}

double unweighted(double energy, double lambda) {
  return lambda > 0 ? energy / lambda : 0.0;
}

}  // namespace

MapFunction::MapFunction(const MapInput& input, const MapConfig& config)
    : config_(config),
      marker_(input.skeleton, input.markers, input.markers_world, config.lambda_marker, config.sigma_m),
      prior_(input.prior, config.lambda_prior),
      smooth_(input.q_prev, input.q_prev2, config.velocity_share, config.lambda_smooth),
      limit_(config.lambda_limit),
      surface_(input.skeleton, input.surface, config.lambda_surface, config.sigma_surface_m),
      contact_(input.skeleton, input.contacts, config.lambda_contact, config.sigma_contact_m) {}

bool MapFunction::operator()(const double* parameters, double* residuals, double* jacobian) const {
  const Pose q = Eigen::Map<const Pose>(parameters);
  Eigen::Map<Residuals> r(residuals);
  evaluateTerm(marker_, kMarkerRow, q, r, jacobian);
  evaluateTerm(prior_, kPriorRow, q, r, jacobian);
  evaluateTerm(smooth_, kSmoothRow, q, r, jacobian);
  evaluateTerm(limit_, kLimitRow, q, r, jacobian);
  evaluateTerm(surface_, kSurfaceRow, q, r, jacobian);
  evaluateTerm(contact_, kContactRow, q, r, jacobian);
  return true;
}

void MapFunction::summarise(const Pose& q, MapSummary& summary) const {
  Residuals r;
  (*this)(q.data(), r.data(), nullptr);
  summary.energy = r.squaredNorm();
  summary.e_marker = unweighted(r.segment<MarkerTerm::kRows>(kMarkerRow).squaredNorm(), config_.lambda_marker);
  summary.e_prior = unweighted(r.segment<PriorTerm::kRows>(kPriorRow).squaredNorm(), config_.lambda_prior);
  summary.e_smooth = unweighted(r.segment<SmoothTerm::kRows>(kSmoothRow).squaredNorm(), config_.lambda_smooth);
  summary.e_limit = unweighted(r.segment<LimitTerm::kRows>(kLimitRow).squaredNorm(), config_.lambda_limit);
  summary.e_surface = unweighted(r.segment<SurfaceTerm::kRows>(kSurfaceRow).squaredNorm(), config_.lambda_surface);
  summary.e_contact = unweighted(r.segment<ContactTerm::kRows>(kContactRow).squaredNorm(), config_.lambda_contact);
  summary.rms_marker_m = marker_.rms(q);
}

}  // namespace depthmocap
