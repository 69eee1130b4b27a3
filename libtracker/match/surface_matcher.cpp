#include "libtracker/match/surface_matcher.h"

#include <algorithm>

#include "depthmocap/error.h"
#include "libtracker/match/lorentzian_weight.h"

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

void SurfaceMatcher::observe(const std::vector<SurfaceSample>& samples, Matching matching) {
  // By distance all parts are held equally likely.
  const double min_probability = matching == Matching::ByParts ? config_.min_probability : 1.0;
  samples_.clear();
  const std::size_t count = std::min<std::size_t>(samples.size(), static_cast<std::size_t>(config_.max_matches));
  for (std::size_t i = 0; i < count; ++i) {
    const SurfaceSample& sample = samples[i * samples.size() / count];
    samples_.push_back({sample.p_world, {sample.probability, min_probability}});
  }
}

double SurfaceMatcher::unexplained(const PlacedSurface& placed, double reach_m) const {
  if (samples_.empty()) return 0;
  static const PartDoubts kNone{{}, 1.0};
  double sum = 0;
  for (const Sample& sample : samples_) {
    const auto found = placed.points.find(sample.p_world, kNone, {reach_m, reach_m});
    sum += found
               ? static_cast<double>((placed.parts[found->part][found->index].p_world - sample.p_world).squaredNorm()) /
                     (reach_m * reach_m)
               : 1.0;
  }
  return sum / static_cast<double>(samples_.size());
}

void SurfaceMatcher::match(const PlacedSurface& placed, SurfaceMatches& matches) const {
  matches.clear();
  const PointLikelihood likelihood{config_.match_sigma_m, config_.max_distance_m};
  for (const Sample& sample : samples_) {
    const auto found = placed.points.find(sample.p_world, sample.doubts, likelihood);
    if (!found) continue;
    const PlacedSurface::Point& nearest = placed.parts[found->part][found->index];
    SurfaceMatch match;
    match.model = nearest.model;
    match.part = partAt(static_cast<int>(found->part));
    match.p_world = sample.p_world.cast<double>();
    match.n_world = nearest.n_world.cast<double>();
    const double off = match.n_world.dot((nearest.p_world - sample.p_world).cast<double>());
    match.weight = lorentzianWeight(off, config_.sigma_m);
    matches.push_back(match);
  }
}

}  // namespace depthmocap
