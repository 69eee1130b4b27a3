#pragma once
#include <array>
#include <string_view>

#include "depthmocap/export.h"

namespace depthmocap {

// Sizes of a body [m], joint centre to joint centre, left and right equal; the paper's s. Defaults: an adult of 1.77 m,
// proportions after Drillis and Contini (1966) and de Leva (1996).
struct BoneLengths {
  double upper_arm = 0.290;       // shoulder to elbow
  double lower_arm = 0.255;       // elbow to wrist
  double upper_leg = 0.425;       // hip to knee
  double lower_leg = 0.420;       // knee to ankle
  double foot = 0.165;            // ankle to toe
  double shoulder_width = 0.350;  // shoulder to shoulder in the T-pose
  double hip_width = 0.175;       // hip to hip
  double torso = 0.520;           // pelvis to neck
  double neck_to_head = 0.180;    // neck to head (centre of the head)
  double spine = 0.180;           // pelvis to spine; less than torso
  double hip_drop = 0.030;        // hips below the pelvis
  double shoulder_drop = 0.050;   // shoulders below the neck in the T-pose

  [[nodiscard]] DEPTHMOCAP_API BoneLengths scaled(double factor) const;
};

inline constexpr int kBoneLengthCount = 12;
// Names in the order of the fields, as in an actor file; and access by index, so that a list of lengths needs no second
// copy.
inline constexpr std::array<std::string_view, kBoneLengthCount> kBoneLengthNames = {
    "upper_arm", "lower_arm", "upper_leg",    "lower_leg", "foot",     "shoulder_width",
    "hip_width", "torso",     "neck_to_head", "spine",     "hip_drop", "shoulder_drop"};
inline constexpr std::array<double BoneLengths::*, kBoneLengthCount> kBoneLengthFields = {
    &BoneLengths::upper_arm,    &BoneLengths::lower_arm,      &BoneLengths::upper_leg, &BoneLengths::lower_leg,
    &BoneLengths::foot,         &BoneLengths::shoulder_width, &BoneLengths::hip_width, &BoneLengths::torso,
    &BoneLengths::neck_to_head, &BoneLengths::spine,          &BoneLengths::hip_drop,  &BoneLengths::shoulder_drop};

// Standing height [m] of a body with these lengths: ankle height + legs + torso + neck_to_head + half a head.
DEPTHMOCAP_API double statureOf(const BoneLengths& lengths);
// Ankle joint above the floor [m] in the zero pose.
DEPTHMOCAP_API double ankleHeight(const BoneLengths& lengths);
// The average body scaled to a stature [m] (> 0).
DEPTHMOCAP_API BoneLengths averageBoneLengths(double stature_m);

}  // namespace depthmocap
