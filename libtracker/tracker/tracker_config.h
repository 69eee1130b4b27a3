#pragma once
#include "libtracker/classify/part_classifier.h"
#include "libtracker/core/config_fields.h"
#include "libtracker/markers/find_markers.h"
#include "libtracker/match/free_space_matcher.h"
#include "libtracker/match/outline_matcher.h"
#include "libtracker/match/surface_matcher.h"
#include "libtracker/posedb/pose_search.h"
#include "libtracker/prior/prior_config.h"
#include "libtracker/segment/segment.h"
#include "libtracker/solve/map_solver.h"

namespace depthmocap {

// When a pose is believed, carried on, given up and looked for again.
struct TrackPolicy {
  int min_markers = 5;        // (1 .. 15) fewer seen markers are not enough evidence for a pose
  double min_visible = 0.45;  // [0 .. 1] of the actor, where something hides the rest; less is not enough either
  double min_head = 0.3;      // [0 .. 1] confidence of head and neck below which a first pose in a room is not believed
  double max_rms_m = 0.15;    // [m] a worse fit of the seen markers is not believed
  double suspect_rms_m = 0.065;  // [m] above it a global search competes with the tracked pose
  double switch_gain = 0.6;      // (0 .. 1) the global pose wins if its energy is below this share of the tracked one's
  double suspect_misfit = 0.10;  // [0 .. 2] of the image unexplained, above which other explanations compete
  double misfit_gain = 0.8;      // (0 .. 1) one wins if it leaves less than this share of the tracked pose's
  double max_misfit = 0.15;      // [0 .. 2] up to which a pose is believed whatever its markers say
  double coast_s = 0.4;          // [s] a pose is carried on without evidence, then the actor is lost
  double absent_s = 2.5;         // [s] (>= coast_s) the lost actor is waited for, then whoever is there is tracked
  int start_poses = 6;           // (>= 1) database poses a global search solves from
  int dense_rounds = 6;          // (>= 0) of matching depth with the body's surface; 0 = markers only, the paper
  int dense_steps = 2;           // (>= 1) of the solver in a round, where a pose follows the one before
  bool expect_sides = true;      // the pose before tells left from right in the classifier's answer; false: the paper
  bool hold_feet = true;         // feet that stand are held where they are; false: the paper
  double assumed_stature_m = 1.72;  // [m] of an uncalibrated actor at the start
  double adapt_s = 3.0;             // [s] of good frames over which an uncalibrated actor's size is fitted
  double shape_s = 10.0;            // [s] of frames over which its bone lengths and girths are fitted; 0 = not
  std::vector<ConfigField> fields();
  void validate() const;
};

// Weights of the solve by measurement (docs/lab/accuracy.md): on radians the paper's prior and smoothness are too weak
// against markers that are centimetres off, and the dense term knows more than the markers.
MapConfig measuredWeights();

// The local model by measurement: a Gaussian over the most neighbours that the paper takes.
PriorConfig measuredPrior();

// Every parameter of the tracker; the defaults work without any file.
struct TrackerConfig {
  SegmentConfig segment;
  ClassifyConfig classify;
  MarkerConfig markers;
  PoseSearchConfig search;
  PriorConfig prior = measuredPrior();
  MapConfig solve = measuredWeights();
  SurfaceMatchConfig surface;
  OutlineConfig outline;
  FreeSpaceConfig free_space;
  TrackPolicy policy;
  int people = 1;   // (1 .. kMostPeople) tracked at the same time
  int threads = 2;  // (>= 1) for the stages that can use them

  // A stage's fields, by the name of the stage.
  struct Section {
    std::string_view name;
    std::vector<ConfigField> fields;
  };
  // All fields of all stages, in the order of the method. `threads` is no field: results do not depend on it; nor is
  // `people`: it is of a run.
  std::vector<Section> sections();
  void validate() const;
};

// The method as the paper gives it: its weights, no dense term, each image classified by itself.
TrackerConfig paperConfig();

}  // namespace depthmocap
