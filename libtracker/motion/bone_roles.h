#pragma once
#include <string>
#include <vector>

#include "libtracker/motion/bone_names.h"
#include "libtracker/motion/source_motion.h"

namespace depthmocap {

// A point rigid with a bone of a motion file, file units.
struct SourcePoint {
  int bone = 0;
  Eigen::Vector3d p_bone = Eigen::Vector3d::Zero();
};

// Which bones of a motion file are which part of the body. A joint is the origin of its bone.
struct BoneRoles {
  struct Side {
    int humerus = -1;
    int radius = -1;
    int femur = -1;
    int tibia = -1;
    int foot = -1;  // the bone of the ankle's joint; -1 where the legs end with their shins
    SourcePoint wrist;
    SourcePoint ankle;
    SourcePoint toe;
  };
  int pelvis = -1;  // the bone that carries both legs
  int thorax = -1;  // the bone that carries the arms and the head
  int spine = -1;   // the joint between pelvis and thorax nearest to a third of the way up; -1 if there is none
  int neck = -1;    // the first joint towards the head that lies above the shoulders
  int head = -1;
  Eigen::Vector3d head_center = Eigen::Vector3d::Zero();  // in the head's frame, file units
  Side left, right;
};

// Finds the roles among named bones, by the rest pose. Error naming `where` and the missing part.
BoneRoles findBoneRoles(const std::vector<MotionBone>& bones, const NamedBones& named, const std::string& where);

// The trunk in the rest pose, file units: hips, neck and the axes left, up (hips to neck), forward as columns of a
// rotation.
struct RestTrunk {
  Eigen::Vector3d hips;
  Eigen::Vector3d neck;
  Eigen::Matrix3d axes;
};
RestTrunk restTrunk(const GlobalFrame& rest, const BoneRoles& roles);

// Metres per unit of a skeleton of unknown unit: of metre, foot, decimetre, centimetre, millimetre, inch and the CMU
// unit (inch / 0.45) the one that brings shin, thigh and trunk together nearest to an adult's 1.4 m. Error naming
// `where` if none comes within a factor of 1.6.
double detectMetresPerUnit(const GlobalFrame& rest, const BoneRoles& roles, const std::string& where);

}  // namespace depthmocap
