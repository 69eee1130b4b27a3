#pragma once
#include <Eigen/Core>
#include <array>
#include <string_view>

#include "depthmocap/joints.h"
#include "libtracker/clinical/cardan.h"
#include "libtracker/skeleton/forward_kinematics.h"

namespace depthmocap {

// Angles as clinics name them (docs/reference/angles.md), in the order of an angles file. Signs are such that left and
// right agree: flexion, abduction and internal rotation are positive.
inline constexpr int kClinicalAngleCount = 31;
inline constexpr std::array<std::string_view, kClinicalAngleCount> kClinicalAngleNames = {
    "pelvis_tilt",
    "pelvis_obliquity",
    "pelvis_rotation",
    "trunk_flexion",
    "trunk_lateral_flexion",
    "trunk_rotation",
    "neck_flexion",
    "neck_lateral_flexion",
    "neck_rotation",
    "left_hip_flexion",
    "left_hip_abduction",
    "left_hip_rotation",
    "left_knee_flexion",
    "left_ankle_dorsiflexion",
    "left_ankle_rotation",
    "left_shoulder_flexion",
    "left_shoulder_abduction",
    "left_shoulder_rotation",
    "left_shoulder_elevation",
    "left_elbow_flexion",
    "right_hip_flexion",
    "right_hip_abduction",
    "right_hip_rotation",
    "right_knee_flexion",
    "right_ankle_dorsiflexion",
    "right_ankle_rotation",
    "right_shoulder_flexion",
    "right_shoulder_abduction",
    "right_shoulder_rotation",
    "right_shoulder_elevation",
    "right_elbow_flexion",
};
// Index of an angle by its name; -1 if there is none.
int clinicalAngleIndex(std::string_view name);

using ClinicalAngles = Eigen::Matrix<double, kClinicalAngleCount, 1>;  // [deg]

// The angles of one pose after another: those about full turns go on from the pose before.
class ClinicalAngleReader {
 public:
  // `fk` of a pose in a world with y up. Its size does not matter.
  const ClinicalAngles& read(const ForwardKinematics& fk);

 private:
  void trunk(const ForwardKinematics& fk);
  void arm(const ForwardKinematics& fk, int side);
  void leg(const ForwardKinematics& fk, int side);
  void set(std::string_view name, double rad);
  void set(int side, std::string_view name, double rad);

  ClinicalAngles angles_ = ClinicalAngles::Zero();  // [deg]
};

// Joints that angles are about, each with a confidence: the least of those of the joints that the angles are read from.
inline constexpr int kClinicalJointCount = 13;
inline constexpr std::array<std::string_view, kClinicalJointCount> kClinicalJointNames = {
    "pelvis",     "trunk",     "neck",       "left_hip",    "left_knee",      "left_ankle", "left_shoulder",
    "left_elbow", "right_hip", "right_knee", "right_ankle", "right_shoulder", "right_elbow"};
using ClinicalConfidence = Eigen::Matrix<double, kClinicalJointCount, 1>;  // [0, 1]
ClinicalConfidence clinicalConfidence(const Eigen::Matrix<double, kJointCount, 1>& confidence);
// The joint that an angle is about, by index of either list.
int clinicalJointOf(int angle);

}  // namespace depthmocap
