#include "libtracker/motion/rig.h"

#include <algorithm>
#include <numbers>

#include <fmt/format.h>

#include "depthmocap/error.h"
#include "libtracker/skeleton/forward_kinematics.h"

namespace depthmocap {
namespace {

// Tips, as shares of the bone before: of fingers, of toes. The head's lies at the crown.
constexpr double kHandPerLowerArm = 0.7;
constexpr double kToesPerFoot = 0.4;
constexpr double kBetween = 0.5;  // where a bone stands that we do not have, as a share of the way

// Names of bones; "*" stands for the side. Empty: the style does not have it.
struct StyleNames {
  std::string_view root;  // stands on the floor
  std::string_view hips;
  std::string_view below_spine, spine, above_spine;  // the middle one turns
  std::string_view neck, above_neck, head, crown;    // likewise the first and the third
  std::array<std::string_view, 8> side;              // in the order of kSideBones, then hand and toes
  std::string_view left, right;
  double arms_down_deg;  // in the rest pose
};

// Documented names of the programs' own characters: MotionBuilder's and Mixamo's characterisation, Blender 3.4's
// metarigs/human.py (its arms hang 29 degrees), Unreal's mannequin (whose arms hang about 45), VRM's humanoid bones.
constexpr std::array<StyleNames, kRigNames.size()> kStyles = {{
    {"",
     "Hips",
     "",
     "Spine",
     "",
     "Neck",
     "",
     "Head",
     "HeadTop_End",
     {"*Shoulder", "*Arm", "*ForeArm", "*UpLeg", "*Leg", "*Foot", "*Hand", "*ToeBase"},
     "Left",
     "Right",
     0},
    {"",
     "mixamorig:Hips",
     "mixamorig:Spine",
     "mixamorig:Spine1",
     "mixamorig:Spine2",
     "mixamorig:Neck",
     "",
     "mixamorig:Head",
     "mixamorig:HeadTop_End",
     {"mixamorig:*Shoulder", "mixamorig:*Arm", "mixamorig:*ForeArm", "mixamorig:*UpLeg", "mixamorig:*Leg",
      "mixamorig:*Foot", "mixamorig:*Hand", "mixamorig:*ToeBase"},
     "Left",
     "Right",
     0},
    {"",
     "spine",
     "spine.001",
     "spine.002",
     "spine.003",
     "spine.004",
     "spine.005",
     "spine.006",
     "head_end",
     {"shoulder.*", "upper_arm.*", "forearm.*", "thigh.*", "shin.*", "foot.*", "hand.*", "toe.*"},
     "L",
     "R",
     29},
    {"root",
     "pelvis",
     "spine_01",
     "spine_02",
     "spine_03",
     "neck_01",
     "",
     "head",
     "head_end",
     {"clavicle_*", "upperarm_*", "lowerarm_*", "thigh_*", "calf_*", "foot_*", "hand_*", "ball_*"},
     "l",
     "r",
     45},
    {"",
     "hips",
     "spine",
     "chest",
     "upperChest",
     "neck",
     "",
     "head",
     "headEnd",
     {"*Shoulder", "*UpperArm", "*LowerArm", "*UpperLeg", "*LowerLeg", "*Foot", "*Hand", "*Toes"},
     "left",
     "right",
     0},
}};

enum SideBone : std::size_t { kClavicle, kUpperArm, kForearm, kThigh, kShin, kFoot, kHand, kToes };

struct BoneName {
  SideBone part;
  bool left;
};

// What a bone of a side is; nothing for those of the trunk.
const BoneName* sideBone(Bone bone) {
  static constexpr std::array<std::pair<Bone, BoneName>, 12> kSideBones = {{{Bone::RightClavicle, {kClavicle, false}},
                                                                            {Bone::LeftClavicle, {kClavicle, true}},
                                                                            {Bone::RightHumerus, {kUpperArm, false}},
                                                                            {Bone::LeftHumerus, {kUpperArm, true}},
                                                                            {Bone::RightRadius, {kForearm, false}},
                                                                            {Bone::LeftRadius, {kForearm, true}},
                                                                            {Bone::RightFemur, {kThigh, false}},
                                                                            {Bone::LeftFemur, {kThigh, true}},
                                                                            {Bone::RightTibia, {kShin, false}},
                                                                            {Bone::LeftTibia, {kShin, true}},
                                                                            {Bone::RightFoot, {kFoot, false}},
                                                                            {Bone::LeftFoot, {kFoot, true}}}};
  for (const auto& [name, found] : kSideBones) {
    if (name == bone) return &found;
  }
  return nullptr;
}

std::string nameOf(const StyleNames& style, SideBone part, bool left) {
  std::string name(style.side[part]);
  const std::size_t at = name.find('*');
  return name.replace(at, 1, left ? style.left : style.right);
}

std::string nameOf(const StyleNames& style, Bone bone) {
  if (const BoneName* side = sideBone(bone)) return nameOf(style, side->part, side->left);
  if (bone == Bone::Root) return std::string(style.hips);
  if (bone == Bone::UpperBack) return std::string(style.spine);
  return std::string(bone == Bone::Neck ? style.neck : style.head);
}

// The bone that stands between a bone of ours and its parent, if the style has one.
std::string_view between(const StyleNames& style, Bone bone) {
  if (bone == Bone::UpperBack) return style.below_spine;
  if (bone == Bone::Head) return style.above_neck;
  return {};
}

}  // namespace

RigStyle rigStyle(std::string_view name) {
  const auto found = std::find(kRigNames.begin(), kRigNames.end(), name);
  if (found == kRigNames.end()) {
    throw Error(fmt::format("there is no rig '{}'", name), "--rig",
                fmt::format("known: {}", fmt::join(kRigNames, " ")));
  }
  return static_cast<RigStyle>(found - kRigNames.begin());
}

int Rig::add(const std::string& name, int parent, const Eigen::Vector3d& offset) {
  MotionBone bone;
  bone.name = name;
  bone.parent = parent;
  bone.offset = offset;
  bones_.push_back(bone);
  return static_cast<int>(bones_.size()) - 1;
}

Rig::Rig(RigStyle style_of, const Skeleton& s) {
  const StyleNames& style = kStyles[static_cast<std::size_t>(style_of)];
  const double down_rad = style.arms_down_deg * std::numbers::pi / 180.0;
  rest_[kRhumerusRz] = down_rad;
  rest_[kLhumerusRz] = -down_rad;
  ForwardKinematics fk;
  fk.update(s, rest_);
  for (std::size_t b = 0; b < kBoneCount; ++b) R_rest_[b] = fk.R_world_bone(static_cast<Bone>(b));
  crown_name_ = style.crown;
  int above_spine = -1;
  if (!style.root.empty()) add(std::string(style.root), -1, Eigen::Vector3d::Zero());
  for (std::size_t b = 0; b < kBoneCount; ++b) {
    const auto bone = static_cast<Bone>(b);
    const bool is_root = bone == Bone::Root;
    int parent = is_root ? static_cast<int>(bones_.size()) - 1 : index_[static_cast<std::size_t>(kBoneParents[b])];
    Eigen::Vector3d offset = is_root
                                 ? Eigen::Vector3d::Zero()
                                 : Eigen::Vector3d(R_rest_[static_cast<std::size_t>(kBoneParents[b])] * s.offset[b]);
    if (const std::string_view name = between(style, bone); !name.empty()) {
      parent = add(std::string(name), parent, kBetween * offset);
      offset *= 1.0 - kBetween;
    }
    if (above_spine >= 0 && kBoneParents[b] == static_cast<int>(Bone::UpperBack)) {
      parent = above_spine;
      offset -= bones_[static_cast<std::size_t>(above_spine)].offset;
    }
    index_[b] = add(nameOf(style, bone), parent, offset);
    if (bone == Bone::UpperBack && !style.above_spine.empty()) {
      above_spine =
          add(std::string(style.above_spine), index_[b], kBetween * s.offset[static_cast<std::size_t>(Bone::Neck)]);
    }
  }
  const auto end = [&](SideBone part, bool left, Bone parent, const Eigen::Vector3d& offset,
                       const Eigen::Vector3d& tip) {
    const Eigen::Matrix3d& R = R_rest_[static_cast<std::size_t>(parent)];
    const auto index = static_cast<std::size_t>(add(nameOf(style, part, left), indexOf(parent), R * offset));
    bones_[index].tip = R * tip;
    bones_[index].has_tip = true;
  };
  MotionBone& head = bones_[static_cast<std::size_t>(indexOf(Bone::Head))];
  head.tip = 2.0 * s.head_center;
  head.has_tip = true;
  const Eigen::Vector3d toes(0, 0, kToesPerFoot * s.lengths.foot);
  end(kHand, false, Bone::RightRadius, s.right_wrist, kHandPerLowerArm * s.right_wrist);
  end(kHand, true, Bone::LeftRadius, s.left_wrist, kHandPerLowerArm * s.left_wrist);
  end(kToes, false, Bone::RightFoot, s.right_toe, toes);
  end(kToes, true, Bone::LeftFoot, s.left_toe, toes);
}

std::vector<Eigen::Vector3d> Rig::positions(const Pose& q) const {
  const Eigen::Vector3d hips = q.head<3>();
  if (movingBones() == 1) return {hips};
  return {Eigen::Vector3d(hips.x(), 0, hips.z()), Eigen::Vector3d(0, hips.y(), 0)};
}

Eigen::Matrix3d Rig::fromRest(Bone bone, const Eigen::Matrix3d& R_parent_bone) const {
  const auto b = static_cast<std::size_t>(bone);
  // Hips are upright in all rest poses; and the T-pose leaves no trace, not even in the sign of a zero.
  if (kBoneParents[b] < 0 || rest_.isZero(0)) return R_parent_bone;
  return R_rest_[static_cast<std::size_t>(kBoneParents[b])] * R_parent_bone * R_rest_[b].transpose();
}

std::vector<Eigen::Quaterniond> Rig::rotations(const Pose& q) const {
  std::vector<Eigen::Quaterniond> rotations(bones_.size(), Eigen::Quaterniond::Identity());
  for (std::size_t b = 0; b < kBoneCount; ++b) {
    const auto bone = static_cast<Bone>(b);
    rotations[static_cast<std::size_t>(index_[b])] = Eigen::Quaterniond(fromRest(bone, localRotation(bone, q)));
  }
  return rotations;
}

}  // namespace depthmocap
