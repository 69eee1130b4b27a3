#pragma once
#include <Eigen/Core>
#include <array>
#include <string_view>

#include "depthmocap/bone_lengths.h"
#include "depthmocap/joints.h"
#include "depthmocap/pose.h"
#include "depthmocap/skeleton.h"

namespace depthmocap {

// How a bone turns in its parent, and where its DoFs start in q.
enum class BoneRotation {
  HeadingTilt,  // Ry(q1) * exp(q0, 0, q2): the root
  SwingTwistY,  // exp(q0, 0, q2) * Ry(q1): bones along y in the zero pose
  SwingTwistX,  // exp(0, q1, q2) * Rx(q0): bones along x
  SwingYZ,      // exp(0, q0, q1)
  SwingXZ,      // exp(q0, 0, q1)
  SwingXY,      // exp(q0, q1, 0)
  HingeX,       // Rx(q0)
  HingeY,       // Ry(q0)
};

struct BoneDofs {
  BoneRotation rotation;
  int first;  // index in q of the bone's first rotational DoF
  int count;
};

inline constexpr std::array<BoneDofs, kBoneCount> kBoneDofs = {{
    {BoneRotation::HeadingTilt, kRootRx, 3},
    {BoneRotation::SwingTwistY, kUpperbackRx, 3},
    {BoneRotation::SwingYZ, kRclavicleRy, 2},
    {BoneRotation::SwingYZ, kLclavicleRy, 2},
    {BoneRotation::SwingTwistX, kRhumerusRx, 3},
    {BoneRotation::SwingTwistX, kLhumerusRx, 3},
    {BoneRotation::HingeY, kRradiusRy, 1},
    {BoneRotation::HingeY, kLradiusRy, 1},
    {BoneRotation::SwingXZ, kNeckRx, 2},
    {BoneRotation::HingeY, kHeadRy, 1},
    {BoneRotation::SwingTwistY, kRfemurRx, 3},
    {BoneRotation::SwingTwistY, kLfemurRx, 3},
    {BoneRotation::HingeX, kRtibiaRx, 1},
    {BoneRotation::HingeX, kLtibiaRx, 1},
    {BoneRotation::SwingXY, kRfootRx, 2},
    {BoneRotation::SwingXY, kLfootRx, 2},
}};

Skeleton makeSkeleton(const BoneLengths& lengths);

// Each contract joint as a point on a bone of this skeleton.
std::array<BonePoint, kJointCount> jointPoints(const Skeleton& skeleton);

}  // namespace depthmocap
