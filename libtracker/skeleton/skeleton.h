#pragma once
#include <Eigen/Core>
#include <array>
#include <string_view>

#include "depthmocap/bone_lengths.h"
#include "depthmocap/joints.h"
#include "depthmocap/pose.h"

namespace depthmocap {

// The rigid segments of the body, parents before children. A bone's frame has its origin at the bone's proximal joint.
enum class Bone : int {
  Root,
  UpperBack,
  RightClavicle,
  LeftClavicle,
  RightHumerus,
  LeftHumerus,
  RightRadius,
  LeftRadius,
  Neck,
  Head,
  RightFemur,
  LeftFemur,
  RightTibia,
  LeftTibia,
  RightFoot,
  LeftFoot,
};

inline constexpr int kBoneCount = 16;

inline constexpr std::array<std::string_view, kBoneCount> kBoneNames = {
    "root", "upperback", "rclavicle", "lclavicle", "rhumerus", "lhumerus", "rradius", "lradius",
    "neck", "head",      "rfemur",    "lfemur",    "rtibia",   "ltibia",   "rfoot",   "lfoot"};

inline constexpr std::array<int, kBoneCount> kBoneParents = {-1, 0, 1, 1, 2, 3, 4, 5, 1, 8, 0, 0, 10, 11, 12, 13};

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

// Where every bone starts in its parent's frame and where the end points lie, for one body. Constant during tracking.
struct Skeleton {
  BoneLengths lengths;
  std::array<Eigen::Vector3d, kBoneCount> offset;  // [m] bone origin in the parent's frame
  Eigen::Vector3d head_center;                     // [m] in the head's frame
  Eigen::Vector3d right_wrist, left_wrist;         // [m] in the radius' frame
  Eigen::Vector3d right_toe, left_toe;             // [m] in the foot's frame
};

Skeleton makeSkeleton(const BoneLengths& lengths);

// A point rigid with a bone: a joint or a marker.
struct BonePoint {
  Bone bone = Bone::Root;
  Eigen::Vector3d p_bone = Eigen::Vector3d::Zero();  // [m]
};

// Each contract joint as a point on a bone of this skeleton.
std::array<BonePoint, kJointCount> jointPoints(const Skeleton& skeleton);

}  // namespace depthmocap
