#pragma once
#include <Eigen/Geometry>
#include <array>
#include <string_view>

#include "libtracker/skeleton/skeleton.h"

namespace depthmocap {

// The humanoid bones of Unity that our skeleton has, in the order in which they are sent.
inline constexpr int kVmcBoneCount = 20;
inline constexpr std::array<std::string_view, kVmcBoneCount> kVmcBoneNames = {
    "Hips",     "Spine",         "Neck",          "Head",          "LeftShoulder", "LeftUpperArm", "LeftLowerArm",
    "LeftHand", "RightShoulder", "RightUpperArm", "RightLowerArm", "RightHand",    "LeftUpperLeg", "LeftLowerLeg",
    "LeftFoot", "LeftToes",      "RightUpperLeg", "RightLowerLeg", "RightFoot",    "RightToes"};

// A bone in its parent, as Unity's transforms have it: left-handed, y up, z forward, metres. All rotations are the
// identity in the T-pose.
struct VmcBone {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
};

// Every bone of a pose; the hips' position is relative to `origin` of our world [m].
std::array<VmcBone, kVmcBoneCount> vmcBones(const Skeleton& skeleton, const Pose& q, const Eigen::Vector3d& origin);

}  // namespace depthmocap
