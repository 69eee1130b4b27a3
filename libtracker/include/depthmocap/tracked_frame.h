#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "depthmocap/bone_lengths.h"
#include "depthmocap/camera_model.h"
#include "depthmocap/image.h"
#include "depthmocap/joints.h"
#include "depthmocap/marker_set.h"
#include "depthmocap/pose.h"
#include "depthmocap/track_state.h"
#include "depthmocap/world_frame.h"

namespace depthmocap {

// Wall time of each stage of one frame [ms].
struct StageTimes {
  double segment = 0;
  double classify = 0;
  double markers = 0;
  double prior = 0;
  double solve = 0;
  double total = 0;
};

// The result of tracking one person in one frame. Valid until the next call of Tracker::process.
struct TrackedFrame {
  int person = 1;  // number of the person, from 1
  std::int64_t frame = 0;
  double time_s = 0;
  TrackState state = TrackState::Lost;
  bool reinitialised = false;  // the pose comes from a global search, not from the frame before
  Pose q = Pose::Zero();       // in the world of this frame; undefined when lost
  // The world (see UprightWorld): p_world = R_world_camera * p_camera; changes where the camera was turned.
  Eigen::Matrix3d R_world_camera = uprightWorldFromCamera();
  std::optional<Eigen::Vector4d> floor_world;             // n.p + d = 0, |n| = 1, n up [m]; if seen
  JointPositions joints_camera = JointPositions::Zero();  // [m]
  Eigen::Matrix<double, kJointCount, 1> confidence = Eigen::Matrix<double, kJointCount, 1>::Zero();  // [0, 1]
  MarkerSet markers_camera;        // found in this frame [m]
  MarkerSet model_markers_camera;  // at the solved pose [m]; confidence 1
  PartImage labels;                // most probable part of each pixel; 0 outside the actor
  double rms_marker_m = 0;         // [m] RMS distance of the seen markers from the solved pose
  double stature_m = 0;            // [m] of the skeleton in use
  BoneLengths lengths;             // [m] the same; an uncalibrated actor's are fitted over the first seconds
  int solver_iterations = 0;
  StageTimes ms;
};

}  // namespace depthmocap
