#pragma once
#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <string_view>
#include <vector>

#include "libtracker/clinical/cardan.h"
#include "libtracker/skeleton/forward_kinematics.h"

namespace depthmocap {

// Our world (y up, the zero pose faces z) in OpenSim's ground (y up, models face x).
Eigen::Vector3d openSimPoint(const Eigen::Vector3d& p_world);

// Coordinates of the full-body model of Rajagopal et al. 2016 that a pose of ours has; gait2392 has those of pelvis,
// legs and trunk, its knees bend the other way.
inline constexpr int kOpenSimCoordinateCount = 27;
inline constexpr std::array<std::string_view, kOpenSimCoordinateCount> kOpenSimCoordinates = {
    "pelvis_tilt",     "pelvis_list",     "pelvis_rotation", "pelvis_tx",     "pelvis_ty",        "pelvis_tz",
    "hip_flexion_r",   "hip_adduction_r", "hip_rotation_r",  "knee_angle_r",  "ankle_angle_r",    "hip_flexion_l",
    "hip_adduction_l", "hip_rotation_l",  "knee_angle_l",    "ankle_angle_l", "lumbar_extension", "lumbar_bending",
    "lumbar_rotation", "arm_flex_r",      "arm_add_r",       "arm_rot_r",     "elbow_flex_r",     "arm_flex_l",
    "arm_add_l",       "arm_rot_l",       "elbow_flex_l"};
using OpenSimCoordinates = Eigen::Matrix<double, kOpenSimCoordinateCount, 1>;  // [deg], pelvis_tx ty tz [m]

// The coordinates of one pose after another; each goes on from the pose before.
class OpenSimReader {
 public:
  // `fk` of a body with hips `hip_width_m` apart. Translations are those of the model's pelvis in ground, scaled so
  // that its hips are as far apart, from `origin_world` on.
  OpenSimCoordinates read(const ForwardKinematics& fk, double hip_width_m, const Eigen::Vector3d& origin_world);

 private:
  struct Limbs {
    CardanAngles hip, arm;
  };
  CardanAngles pelvis_, lumbar_;
  std::array<Limbs, 2> limbs_;  // left, right
};

// Coordinates over time.
struct OpenSimRow {
  double time_s = 0;
  OpenSimCoordinates values = OpenSimCoordinates::Zero();
};

// Writes a motion file (.mot), whole or not at all.
void writeMot(const std::vector<OpenSimRow>& rows, const std::filesystem::path& path);

}  // namespace depthmocap
