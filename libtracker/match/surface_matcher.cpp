#include "libtracker/match/surface_matcher.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "depthmocap/error.h"

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
  const auto max_d = static_cast<float>(config_.max_distance_m * config_.max_distance_m);
  const auto per_d = static_cast<float>(0.5 / (config_.match_sigma_m * config_.match_sigma_m));
  const auto min_probability = static_cast<float>(config_.min_probability);
  const std::size_t count = std::min<std::size_t>(samples.size(), static_cast<std::size_t>(config_.max_matches));
  for (std::size_t i = 0; i < count; ++i) {
    const SurfaceSample& sample = samples[i * samples.size() / count];
    float best = std::numeric_limits<float>::max();
    const PlacedSurface::Point* nearest = nullptr;
    for (std::size_t part = 0; part < kPartCount; ++part) {
      // Half the squared distance over sigma^2, and what the classifier thinks of the part, as log likelihoods.
      const float doubt = -std::log(std::max(sample.probability[part], min_probability));
      for (const PlacedSurface::Point& point : placed.parts[part]) {
        const float d = (point.p_world - sample.p_world).squaredNorm();
        const float cost = d * per_d + doubt;
        if (cost >= best || d > max_d) continue;
        best = cost;
        nearest = &point;
      }
    }
    if (nearest == nullptr) continue;
    SurfaceMatch match;
    match.model = nearest->model;
    match.p_world = sample.p_world.cast<double>();
    match.n_world = nearest->n_world.cast<double>();
    const double off = match.n_world.dot((nearest->p_world - sample.p_world).cast<double>());
    match.weight = 1.0 / (1.0 + off * off / (2.0 * config_.sigma_m * config_.sigma_m));
    matches.push_back(match);
  }
}

}  // namespace depthmocap
