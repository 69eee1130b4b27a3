#pragma once
#include <vector>

#include "calibration/pose_observation.h"
#include "calibration/shape_space.h"
#include "libtracker/actor/body_template.h"
#include "libtracker/skeleton/marker_model.h"

namespace depthmocap {

// Weights of the joint solve. Every term is a squared residual over its deviation. The weights of a set of frames in
// one pose add up to 1, because what the body and the classifier do to them is the same in each.
struct JointSolveConfig {
  double surface_points = 80;  // (>= 0) the cloud counts as this many independent points; 0 = no such term
  int rounds = 5;              // (>= 1) of matching the cloud and solving
  int iterations = 6;          // (>= 1) of Levenberg-Marquardt in each
  int threads = 1;             // (>= 1)
};

struct JointSolution {
  ShapeVector shape = ShapeVector::Zero();
  MarkerModel markers{};
  std::vector<Pose> poses;   // one an observation
  double rms_surface_m = 0;  // [m] cloud to surface, over the matched points
  double matched_share = 0;  // [0, 1] of the cloud
  double rms_marker_m = 0;   // [m]
  double cost = 0;           // what the solve minimised, after its last round
};

// argmin over s, v (and the girths and poses, which the paper takes as given) of
//   sum_t || f(s, v; q_t) - a*_t ||^2 + gamma || (I - H H^T)(s - s_mean) ||^2
// of method section A (6), with the terms beyond the paper that the config names, by Levenberg-Marquardt (Ceres) with
// analytic Jacobians. Starts from `shape` and the observations' poses.
JointSolution solveJointly(const BodyTemplate& body, const ShapeSpace& space,
                           const std::vector<PoseObservation>& observations, const ShapeVector& shape,
                           const JointSolveConfig& config);

}  // namespace depthmocap
