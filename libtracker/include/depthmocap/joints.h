#pragma once
#include <Eigen/Core>
#include <array>
#include <string_view>

namespace depthmocap {

// The 18 joint centres of a joints file, in its column order. Left and right are the actor's own.
enum class Joint : int {
  Pelvis,
  Spine,
  Neck,
  Head,
  LeftShoulder,
  LeftElbow,
  LeftWrist,
  RightShoulder,
  RightElbow,
  RightWrist,
  LeftHip,
  LeftKnee,
  LeftAnkle,
  LeftToe,
  RightHip,
  RightKnee,
  RightAnkle,
  RightToe,
};

inline constexpr int kJointCount = 18;

inline constexpr std::array<std::string_view, kJointCount> kJointNames = {
    "pelvis",     "spine",          "neck",        "head",        "left_shoulder", "left_elbow",
    "left_wrist", "right_shoulder", "right_elbow", "right_wrist", "left_hip",      "left_knee",
    "left_ankle", "left_toe",       "right_hip",   "right_knee",  "right_ankle",   "right_toe"};

// Joint positions [m], one column per joint. Each use states the frame.
using JointPositions = Eigen::Matrix<double, 3, kJointCount>;

}  // namespace depthmocap
