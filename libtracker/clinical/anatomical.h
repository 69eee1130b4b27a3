#pragma once
#include <Eigen/Core>

#include "libtracker/skeleton/forward_kinematics.h"

namespace depthmocap {

enum class BodySide { Left, Right };

// The bones of one side.
struct SideBones {
  Bone humerus, radius, femur, tibia, foot;
};
constexpr SideBones bonesOf(BodySide side) {
  if (side == BodySide::Left)
    return {Bone::LeftHumerus, Bone::LeftRadius, Bone::LeftFemur, Bone::LeftTibia, Bone::LeftFoot};
  return {Bone::RightHumerus, Bone::RightRadius, Bone::RightFemur, Bone::RightTibia, Bone::RightFoot};
}

// What is about the forward and the upward axis on the right is the mirror image on the left: 1 right, -1 left.
constexpr double mirrorSign(BodySide side) {
  return side == BodySide::Right ? 1.0 : -1.0;
}

// A bone in another one.
inline Eigen::Matrix3d relativeRotation(const ForwardKinematics& fk, Bone parent, Bone bone) {
  return fk.R_world_bone(parent).transpose() * fk.R_world_bone(bone);
}

// The upper arm in the thorax, counted from the arm that hangs down with the elbow's axis across the body: our bones
// count from the T-pose.
Eigen::Matrix3d armInThorax(const ForwardKinematics& fk, BodySide side);

// Elbow and knee bend in one direction; flexion [rad].
double elbowFlexion(const ForwardKinematics& fk, BodySide side);
double kneeFlexion(const ForwardKinematics& fk, BodySide side);
// The foot's direction in the shank, counted from a right angle: toes up, toes to the inside [rad].
struct FootAngles {
  double dorsiflexion = 0;
  double inwards = 0;
};
FootAngles footAngles(const ForwardKinematics& fk, BodySide side);

// A limb's direction (unit, x left, y up, z forward) as an angle from hanging down, shared between forward and left: no
// direction short of straight up is singular [rad].
struct Tilt {
  double angle = 0;
  double forward = 0;
  double left = 0;
};
Tilt tiltFromDown(const Eigen::Vector3d& direction);

}  // namespace depthmocap
