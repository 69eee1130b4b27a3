#pragma once
#include <cstdint>
#include <vector>

#include "libtracker/ik/ik_solver.h"
#include "libtracker/posedb/pose_database.h"

namespace depthmocap {

// The experiment of the MNN-IK paper: some joints of true poses, chosen at random, are the targets.
struct IkExperimentConfig {
  int poses = 500;     // (>= 1) drawn from the database, with any heading
  int joints = 6;      // (1 .. kJointCount) given of each
  double noise_m = 0;  // [m] (>= 0) deviation of each coordinate of a target
  std::uint64_t seed = 1;
};

struct IkTask {
  Pose truth = Pose::Zero();
  JointTargets targets;
};

// The tasks depend on the database, the body and the configuration alone.
std::vector<IkTask> ikTasks(const PoseDatabase& database, const Skeleton& skeleton, const IkExperimentConfig& config);

// Against the truth, averaged over tasks.
struct IkFigures {
  double position_m = 0;    // [m] of all 18 joints
  double rotation_deg = 0;  // [deg] angle between the local rotations of a bone, over all bones
  double residual_m = 0;    // [m] IkResult::residual_m
  double solve_ms = 0;      // [ms] mean processor time of a solve
};

IkFigures measureIk(const IkSolver& solver, const std::vector<IkTask>& tasks, int threads);

// The same from pictures in scaled orthographic projection of bodies that face `yaw_rad` away from the viewer, all 18
// joints given. The depth of the root, which such a picture does not have, is taken from the truth.
IkFigures measureImageIk(const IkSolver& solver, const std::vector<IkTask>& tasks, double yaw_rad, int threads);

}  // namespace depthmocap
