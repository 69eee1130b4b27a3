#pragma once
#include <array>

#include "depthmocap/joints.h"

namespace depthmocap {

// A line between two joints.
struct BoneLine {
  Joint from;
  Joint to;
};

// The lines of the stick figure, from the pelvis outwards: each joint but the pelvis ends one.
inline constexpr std::array<BoneLine, kJointCount - 1> kBoneLines{{{Joint::Pelvis, Joint::Spine},
                                                                   {Joint::Spine, Joint::Neck},
                                                                   {Joint::Neck, Joint::Head},
                                                                   {Joint::Neck, Joint::LeftShoulder},
                                                                   {Joint::LeftShoulder, Joint::LeftElbow},
                                                                   {Joint::LeftElbow, Joint::LeftWrist},
                                                                   {Joint::Neck, Joint::RightShoulder},
                                                                   {Joint::RightShoulder, Joint::RightElbow},
                                                                   {Joint::RightElbow, Joint::RightWrist},
                                                                   {Joint::Pelvis, Joint::LeftHip},
                                                                   {Joint::LeftHip, Joint::LeftKnee},
                                                                   {Joint::LeftKnee, Joint::LeftAnkle},
                                                                   {Joint::LeftAnkle, Joint::LeftToe},
                                                                   {Joint::Pelvis, Joint::RightHip},
                                                                   {Joint::RightHip, Joint::RightKnee},
                                                                   {Joint::RightKnee, Joint::RightAnkle},
                                                                   {Joint::RightAnkle, Joint::RightToe}}};

}  // namespace depthmocap
