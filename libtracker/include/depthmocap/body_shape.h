#pragma once
#include <Eigen/Core>
#include <array>
#include <string_view>

#include "depthmocap/bone_lengths.h"

namespace depthmocap {

enum class Sex { Male, Female };

// Girths of a body, left and right equal, as factors of the template's; trunk and hips have a width and a depth.
enum class Girth : int {
  Head,
  Neck,
  Shoulder,
  UpperArm,
  LowerArm,
  TorsoWidth,
  TorsoDepth,
  WaistWidth,
  WaistDepth,
  UpperLeg,
  LowerLeg,
};
inline constexpr int kGirthCount = 11;
inline constexpr std::array<std::string_view, kGirthCount> kGirthNames = {
    "head",        "neck",        "shoulder",    "upper_arm", "lower_arm", "torso_width",
    "torso_depth", "waist_width", "waist_depth", "upper_leg", "lower_leg"};

// What shapes a body: its bone lengths s [m], then its girths.
inline constexpr int kShapeCount = kBoneLengthCount + kGirthCount;
using ShapeVector = Eigen::Matrix<double, kShapeCount, 1>;

}  // namespace depthmocap
