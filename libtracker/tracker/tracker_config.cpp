#include "libtracker/tracker/tracker_config.h"

namespace depthmocap {
MapConfig measuredWeights() {
  MapConfig weights;
  weights.lambda_prior = 100.0;
  weights.lambda_smooth = 20.0;
  weights.velocity_share = 0.8;
  weights.lambda_surface = 2.0;
  weights.prior_freedom = 8.0;
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
  config.policy.shape_s = 0;
  config.policy.expect_sides = false;
  config.policy.hold_feet = false;
  return config;
}

std::vector<ConfigField> TrackPolicy::fields() {
  return {
      {"min_markers", &min_markers, "markers", fromTo(1, kPartCount), "Fewer seen markers are not enough for a pose"},
      {"min_visible", &min_visible, "", fromTo(0, 1), "A smaller visible share of the actor is not enough either"},
      {"min_head", &min_head, "", fromTo(0, 1),
       "In a room a first pose is not believed if the confidence of the head or the neck is less"},
      {"max_rms_m", &max_rms_m, "m", above(0), "A worse fit of the seen markers is not believed"},
      {"suspect_rms_m", &suspect_rms_m, "m", above(0), "Above it a global search competes with the tracked pose"},
      {"switch_gain", &switch_gain, "", between(0, 1),
       "The global pose wins if its energy is below this share of that of the tracked one"},
      {"suspect_misfit", &suspect_misfit, "", atLeast(0),
       "Above this share of the image unexplained, other explanations compete with the tracked pose"},
      {"misfit_gain", &misfit_gain, "", between(0, 1),
       "One wins if it leaves less than this share of what the tracked pose leaves"},
      {"max_misfit", &max_misfit, "", atLeast(0), "Up to it a pose is believed whatever its markers say"},
      {"coast_s", &coast_s, "s", atLeast(0), "A pose is carried on without evidence this long"},
      {"absent_s", &absent_s, "s", atLeast(0), "A lost actor is waited for this long"},
      {"start_poses", &start_poses, "poses", atLeast(1), "Database poses that a global search solves from"},
      {"dense_rounds", &dense_rounds, "", atLeast(0),
       "Rounds of matching depth with the surface, where a pose follows the one before; 0 = markers only"},
      {"dense_steps", &dense_steps, "", atLeast(1),
       "Steps of the solver in a round, where a pose follows the one before"},
      {"expect_sides", &expect_sides, "", kAnyNumber, "The pose before tells left from right"},
      {"hold_feet", &hold_feet, "", kAnyNumber, "Feet that stand are held where they are"},
      {"assumed_stature_m", &assumed_stature_m, "m", fromTo(1.0, 2.2), "Of an uncalibrated actor at the start"},
      {"adapt_s", &adapt_s, "s", atLeast(0), "Good frames over which the size of an uncalibrated actor is fitted"},
      {"shape_s", &shape_s, "s", atLeast(0),
       "Frames over which its bone lengths and girths are fitted; 0 = not at all"},
  };
}

void TrackPolicy::validate() const {
  checkFieldsOf("TrackPolicy", *this);
  checkConfig(absent_s >= coast_s, "TrackPolicy", "absent_s", absent_s, "at least coast_s");
}

std::vector<TrackerConfig::Section> TrackerConfig::sections() {
  return {{"segment", segment.fields()}, {"classify", classify.fields()}, {"markers", markers.fields()},
          {"search", search.fields()},   {"prior", prior.fields()},       {"solve", solve.fields()},
          {"surface", surface.fields()}, {"outline", outline.fields()},   {"free_space", free_space.fields()},
          {"policy", policy.fields()}};
}

void TrackerConfig::validate() const {
  segment.validate();
  classify.validate();
  markers.validate();
  search.validate();
  prior.validate();
  solve.validate();
  surface.validate();
  outline.validate();
  free_space.validate();
  policy.validate();
  checkConfig(people >= 1 && people <= kMostPeople, "TrackerConfig", "people", people, "from 1 to 6");
  checkConfig(threads >= 1, "TrackerConfig", "threads", threads, "at least 1");
}

}  // namespace depthmocap
