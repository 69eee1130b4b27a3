#include "libtracker/match/surface_matcher.h"

#include <algorithm>

#include "depthmocap/error.h"
#include "libtracker/match/most_likely_point.h"

namespace depthmocap {
std::vector<ConfigField> SurfaceMatchConfig::fields() {
  return {
      {"max_distance_m", &max_distance_m, "m", above(0), "A sample farther from its surface point has no match"},
      {"match_sigma_m", &match_sigma_m, "m", above(0), "Expected distance of the surface from a sample of its part"},
      {"min_probability", &min_probability, "", aboveUpTo(0, 1), "No part is held less likely"},
      {"sigma_m", &sigma_m, "m", above(0), "Scale of the Lorentzian that weighs a match by its distance"},
      {"max_matches", &max_matches, "", fromTo(1, kMaxSurfaceMatches), "Matches per frame"},
  };
}

void SurfaceMatchConfig::validate() const {
  checkFieldsOf("SurfaceMatchConfig", *this);
}

SurfaceMatcher::SurfaceMatcher(const SurfaceMatchConfig& config) : config_(config) {
  config_.validate();
}

void SurfaceMatcher::match(const PlacedSurface& placed, const std::vector<SurfaceSample>& samples,
                           SurfaceMatches& matches) const {
  matches.clear();
  const PointLikelihood likelihood{config_.match_sigma_m, config_.max_distance_m, config_.min_probability};
  const std::size_t count = std::min<std::size_t>(samples.size(), static_cast<std::size_t>(config_.max_matches));
  for (std::size_t i = 0; i < count; ++i) {
    const SurfaceSample& sample = samples[i * samples.size() / count];
    const PlacedSurface::Point* nearest = mostLikelyPoint(placed.parts, sample.p_world, sample.probability, likelihood);
    if (nearest == nullptr) continue;
    SurfaceMatch match;
    match.model = nearest->model;
    match.p_world = sample.p_world.cast<double>();
    match.n_world = nearest->n_world.cast<double>();
    const double off = match.n_world.dot((nearest->p_world - sample.p_world).cast<double>());
    match.weight = lorentzianWeight(off, config_.sigma_m);
    matches.push_back(match);
  }
}

}  // namespace depthmocap
