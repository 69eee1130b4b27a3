#pragma once
#include <Eigen/Core>
#include <array>
#include <string_view>

#include "depthmocap/bone_lengths.h"
#include "depthmocap/parts.h"

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

// Where every bone starts in its parent's frame and where the end points lie, for one body. Constant during tracking.
struct Skeleton {
  BoneLengths lengths;
  std::array<Eigen::Vector3d, kBoneCount> offset;  // [m] bone origin in the parent's frame
  Eigen::Vector3d head_center;                     // [m] in the head's frame
  Eigen::Vector3d right_wrist, left_wrist;         // [m] in the radius' frame
  Eigen::Vector3d right_toe, left_toe;             // [m] in the foot's frame
};

// A point rigid with a bone: a joint or a marker.
struct BonePoint {
  Bone bone = Bone::Root;
  Eigen::Vector3d p_bone = Eigen::Vector3d::Zero();  // [m]
};

// Where the marker of each part sits on the skeleton: the paper's marker offsets v. Index = partIndex(part).
using MarkerModel = std::array<BonePoint, kPartCount>;

// Distance of the marker of each part behind the surface that a camera sees [m]. Index = partIndex(part).
using PartRadii = std::array<double, kPartCount>;

}  // namespace depthmocap
