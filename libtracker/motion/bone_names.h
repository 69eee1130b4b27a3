#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "libtracker/motion/source_motion.h"

namespace depthmocap {

// Indices of a motion file's bones by what their names say they are; -1 where no name says it.
struct NamedBones {
  struct Side {
    int humerus = -1;
    int radius = -1;
    int wrist = -1;  // ASF skeletons have a bone between radius and hand
    int hand = -1;
    int finger_base = -1;
    int femur = -1;
    int tibia = -1;
    int foot = -1;
    int toe = -1;
  };
  int head = -1;
  int crown = -1;  // the end of the head where it is a bone
  Side left, right;
};

// A bone of the file for a part of the body, "left_upper_arm": "Bone 12".
using BoneMap = std::map<std::string, std::string>;

// Reads a bone map from a JSON object. Error naming the file for an unknown part.
BoneMap readBoneMap(const std::filesystem::path& path);

// Finds bones by the vocabulary of ASF, MotionBuilder, Mixamo, Poser, Daz, Rigify, MakeHuman, Unreal, Unity and VRM,
// 3ds Max Biped, Kinect, SMPL, Xsens, OptiTrack, Rokoko, Perception Neuron and their like: the side (L, left, ...) may
// stand before, behind or within the name, after any prefix; case and separators do not matter. What `map` says comes
// first. Error naming `where` for a bone of the map that the file does not have.
NamedBones namedBones(const std::vector<MotionBone>& bones, const BoneMap& map, const std::string& where);

}  // namespace depthmocap
