#include "libtracker/tracker/tracker_config.h"

#include <string>

#include "depthmocap/error.h"

namespace depthmocap {
namespace {

void require(bool holds, const char* rule) {
  if (!holds) throw Error(rule, "TrackPolicy");
}

}  // namespace

MapConfig measuredWeights() {
  MapConfig weights;
  weights.lambda_prior = 100.0;
  weights.lambda_smooth = 20.0;
  weights.velocity_share = 0.8;
  weights.lambda_surface = 2.0;
  return weights;
}

PriorConfig measuredPrior() {
  PriorConfig prior;
  prior.neighbours = {kMaxPriorNeighbours};
  prior.residual_rad = 0.05;
  return prior;
}

TrackerConfig paperConfig() {
  TrackerConfig config;
  config.prior = PriorConfig{};
  config.solve = MapConfig{};
  config.policy.dense_rounds = 0;
  config.policy.expect_sides = false;
  config.policy.hold_feet = false;
  return config;
}

void TrackPolicy::validate() const {
  require(min_markers >= 1 && min_markers <= kPartCount, "min_markers must be from 1 to 15");
  require(min_visible >= 0 && min_visible <= 1, "min_visible must lie between 0 and 1");
  require(max_rms_m > 0, "max_rms_m must be positive");
  require(suspect_rms_m > 0, "suspect_rms_m must be positive");
  require(switch_gain > 0 && switch_gain < 1, "switch_gain must lie between 0 and 1");
  require(coast_s >= 0, "coast_s must not be negative");
  require(absent_s >= coast_s, "absent_s must not be less than coast_s");
  require(start_poses >= 1, "start_poses must be at least 1");
  require(dense_rounds >= 0, "dense_rounds must not be negative");
  require(assumed_stature_m >= 1.0 && assumed_stature_m <= 2.2, "assumed_stature_m must lie between 1.0 and 2.2");
  require(adapt_s >= 0, "adapt_s must not be negative");
}

void TrackerConfig::validate() const {
  segment.validate();
  markers.validate();
  search.validate();
  prior.validate();
  solve.validate();
  surface.validate();
  free_space.validate();
  policy.validate();
  if (classify.stride < 1) throw Error("stride must be at least 1", "ClassifyConfig");
  if (threads < 1) throw Error("threads must be at least 1", "TrackerConfig");
}

}  // namespace depthmocap
