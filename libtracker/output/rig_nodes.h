#pragma once
#include <Eigen/Geometry>
#include <array>
#include <string>
#include <vector>

#include "libtracker/body/body_surface.h"
#include "libtracker/motion/rig.h"

namespace depthmocap {

// The nodes of a rig in formats with a surface: the rig's bones, bones for what a skin is attached to besides (limbs
// without their twist, see BodySurface), and the crown. All frames are parallel to the world in the rest pose.
class RigNodes {
 public:
  struct Node {
    std::string name;
    int parent;              // index of a node, smaller than its own; -1: none
    Eigen::Vector3d offset;  // [m] in the parent, in the rest pose
  };
  RigNodes(RigStyle style, const Skeleton& skeleton);

  [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }
  // The node of each of the skin's bones.
  [[nodiscard]] int nodeOf(int skin_bone) const { return node_of_[static_cast<std::size_t>(skin_bone)]; }
  [[nodiscard]] int movingNodes() const { return rig_.movingBones(); }
  [[nodiscard]] const Rig& rig() const { return rig_; }

  // Positions [m] of the moving nodes in their parents, and the rotation of what carries skin in its parent.
  [[nodiscard]] std::vector<Eigen::Vector3d> positions(const Pose& q) const { return rig_.positions(q); }
  [[nodiscard]] Eigen::Quaterniond rotation(int skin_bone, const Pose& q) const;

 private:
  Rig rig_;
  std::vector<Node> nodes_;
  std::array<int, kSkinBoneCount> node_of_{};
};

}  // namespace depthmocap
