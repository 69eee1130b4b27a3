#include "libtracker/skeleton/skeleton.h"

namespace depthmocap {
namespace {

// Ankle above the floor and head centre to crown, as shares of the leg and of neck_to_head (Drillis and Contini 1966).
constexpr double kAnkleHeightPerLowerLeg = 0.17;
constexpr double kCrownPerNeckToHead = 0.70;
// The foot slopes down from ankle to toe: the toe joint lies near the floor, the ankle at ankle height.
Eigen::Vector3d footDirection() {
  return Eigen::Vector3d(0.0, -0.35, 0.93675).normalized();
}
// The clavicles start beside the breast bone, this share of the half shoulder width out and a little below the neck.
constexpr double kClavicleOriginShare = 0.12;
// The neck turns halfway up towards the head centre.
constexpr double kHeadJointShare = 0.45;

}  // namespace

BoneLengths BoneLengths::scaled(double factor) const {
  BoneLengths result = *this;
  for (auto field : kBoneLengthFields) result.*field *= factor;
  return result;
}

double ankleHeight(const BoneLengths& l) {
  return kAnkleHeightPerLowerLeg * l.lower_leg;
}

double statureOf(const BoneLengths& l) {
  return l.lower_leg * (1.0 + kAnkleHeightPerLowerLeg) + l.upper_leg + l.hip_drop + l.torso +
         l.neck_to_head * (1.0 + kCrownPerNeckToHead);
}

BoneLengths averageBoneLengths(double stature_m) {
  const BoneLengths average;
  return average.scaled(stature_m / statureOf(average));
}

Skeleton makeSkeleton(const BoneLengths& l) {
  Skeleton s;
  s.lengths = l;
  for (auto& offset : s.offset) offset.setZero();
  const auto set = [&](Bone bone, double x, double y, double z) {
    s.offset[static_cast<std::size_t>(bone)] = Eigen::Vector3d(x, y, z);
  };
  const double half_shoulder = 0.5 * l.shoulder_width;
  const double clavicle_x = kClavicleOriginShare * half_shoulder;
  const double clavicle_y = 0.5 * l.shoulder_drop;
  const double up = l.torso - l.spine;
  set(Bone::UpperBack, 0, l.spine, 0);
  set(Bone::Neck, 0, up, 0);
  set(Bone::Head, 0, kHeadJointShare * l.neck_to_head, 0);
  s.head_center = Eigen::Vector3d(0, (1.0 - kHeadJointShare) * l.neck_to_head, 0);
  const auto limb = [&](double side, Bone clavicle, Bone humerus, Bone radius, Bone femur, Bone tibia, Bone foot) {
    set(clavicle, side * clavicle_x, up - clavicle_y, 0);
    set(humerus, side * (half_shoulder - clavicle_x), clavicle_y - l.shoulder_drop, 0);
    set(radius, side * l.upper_arm, 0, 0);
    set(femur, side * 0.5 * l.hip_width, -l.hip_drop, 0);
    set(tibia, 0, -l.upper_leg, 0);
    set(foot, 0, -l.lower_leg, 0);
  };
  limb(-1.0, Bone::RightClavicle, Bone::RightHumerus, Bone::RightRadius, Bone::RightFemur, Bone::RightTibia,
       Bone::RightFoot);
  limb(1.0, Bone::LeftClavicle, Bone::LeftHumerus, Bone::LeftRadius, Bone::LeftFemur, Bone::LeftTibia, Bone::LeftFoot);
  s.right_wrist = Eigen::Vector3d(-l.lower_arm, 0, 0);
  s.left_wrist = Eigen::Vector3d(l.lower_arm, 0, 0);
  s.right_toe = s.left_toe = l.foot * footDirection();
  return s;
}

std::array<BonePoint, kJointCount> jointPoints(const Skeleton& s) {
  const Eigen::Vector3d zero = Eigen::Vector3d::Zero();
  return {{{Bone::Root, zero},
           {Bone::UpperBack, zero},
           {Bone::Neck, zero},
           {Bone::Head, s.head_center},
           {Bone::LeftHumerus, zero},
           {Bone::LeftRadius, zero},
           {Bone::LeftRadius, s.left_wrist},
           {Bone::RightHumerus, zero},
           {Bone::RightRadius, zero},
           {Bone::RightRadius, s.right_wrist},
           {Bone::LeftFemur, zero},
           {Bone::LeftTibia, zero},
           {Bone::LeftFoot, zero},
           {Bone::LeftFoot, s.left_toe},
           {Bone::RightFemur, zero},
           {Bone::RightTibia, zero},
           {Bone::RightFoot, zero},
           {Bone::RightFoot, s.right_toe}}};
}

}  // namespace depthmocap
