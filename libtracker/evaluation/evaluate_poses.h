#pragma once
#include <vector>

#include "depthmocap/pose.h"
#include "libtracker/evaluation/evaluate_joints.h"
#include "libtracker/recording/track_files.h"

namespace depthmocap {

// Joint angles against the truth. A mean over nothing is NaN.
struct PoseFigures {
  int compared = 0;  // frames that both files have
  // [deg] mean absolute difference of each DoF, wrapped to at most 180; index = Dof. Root translations are NaN here.
  Pose error_deg;
  double mean_angle_error_deg = 0;        // [deg] over the DoFs from kFirstBodyDof on: the joint angles
  double mean_root_position_error_m = 0;  // [m]
};

// Frames are matched by number. Both files must use the same world frame.
PoseFigures evaluatePoses(const std::vector<PoseRow>& tracked, const std::vector<PoseRow>& truth,
                          const EvaluationOptions& options);

}  // namespace depthmocap
