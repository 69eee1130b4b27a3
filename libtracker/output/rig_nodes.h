#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "libtracker/skeleton/skeleton.h"

namespace depthmocap {

// A node of the skeleton that glTF files have: named as in BVH files, at rest in the T-pose, y up, facing +z.
struct RigNode {
  std::string name;
  int parent;              // index of a node; -1: none
  Eigen::Vector3d offset;  // [m] in the parent
};

// The first kSkinBoneCount nodes are the skin bones in their order, which turn; then hands, toes and `HeadTop_End`.
std::vector<RigNode> rigNodes(const Skeleton& skeleton);

// Rotation of a node in its parent; the identity for those after the skin bones.
Eigen::Matrix3d rigNodeRotation(int node, const Pose& q);

}  // namespace depthmocap
