#include "libtracker/solve/map_energy.h"

namespace depthmocap {
namespace {

double unweighted(double energy, double lambda) {
  return lambda > 0 ? energy / lambda : 0.0;
}

}  // namespace

MapEnergy::MapEnergy(const MapInput& input, const MapConfig& config)
    : config_(config),
      skeleton_(input.skeleton),
      marker_(input.markers, input.markers_world, config.lambda_marker, config.sigma_m),
      prior_(input.prior, config.lambda_prior, config.prior_freedom),
      smooth_(input.q_prev, input.q_prev2, config.velocity_share, config.lambda_smooth),
      limit_(config.lambda_limit),
      surface_(input.surface, config.lambda_surface, config.sigma_surface_m),
      contact_(input.contacts, config.lambda_contact, config.sigma_contact_m) {}

double MapEnergy::at(const Pose& q) {
  q_ = q;
  fk_.update(skeleton_, q);
  return marker_.energy(fk_) + prior_.energy(q) + smooth_.energy(q) + limit_.energy(q) + surface_.energy(fk_) +
         contact_.energy(fk_);
}

void MapEnergy::expand(double energy, NormalEquations& equations) {
  equations.reset();
  equations.energy = energy;
  prior_.addTo(q_, equations);
  smooth_.addTo(q_, equations);
  limit_.addTo(q_, equations);
  twists_.reset(fk_);
  marker_.addTo(fk_, twists_);
  surface_.addTo(fk_, twists_);
  contact_.addTo(fk_, twists_);
  twists_.addTo(equations);
}

void MapEnergy::summarise(const Pose& q, MapSummary& summary) {
  summary.energy = at(q);
  summary.e_marker = unweighted(marker_.energy(fk_), config_.lambda_marker);
  summary.e_prior = unweighted(prior_.energy(q), config_.lambda_prior);
  summary.e_smooth = unweighted(smooth_.energy(q), config_.lambda_smooth);
  summary.e_limit = unweighted(limit_.energy(q), config_.lambda_limit);
  summary.e_surface = unweighted(surface_.energy(fk_), config_.lambda_surface);
  summary.e_contact = unweighted(contact_.energy(fk_), config_.lambda_contact);
  summary.rms_marker_m = marker_.rms(fk_);
}

}  // namespace depthmocap
