#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>

#include "depthmocap/joints.h"
#include "depthmocap/pose.h"
#include "libtracker/skeleton/skeleton.h"

namespace depthmocap {

using PointJacobian = Eigen::Matrix<double, 3, kDofCount>;  // d p_world / d q, [m/m] and [m/rad]

// Every bone's frame in the world for one pose. Plain working memory: reuse one object in a loop, nothing is allocated.
class ForwardKinematics {
 public:
  void update(const Skeleton& skeleton, const Pose& q);

  [[nodiscard]] const Eigen::Matrix3d& R_world_bone(Bone bone) const {
    return R_world_[static_cast<std::size_t>(bone)];
  }
  // World position of the bone's origin [m].
  [[nodiscard]] const Eigen::Vector3d& origin(Bone bone) const { return p_world_[static_cast<std::size_t>(bone)]; }
  // World position [m] of a point rigid with a bone.
  [[nodiscard]] Eigen::Vector3d position(const BonePoint& point) const {
    return R_world_bone(point.bone) * point.p_bone + origin(point.bone);
  }
  // Instantaneous rotation axis [world] of a rotational DoF, which turns its bone and all behind it about the bone's
  // origin: d R_world_bone / d q_i = [axis]x R_world_bone.
  [[nodiscard]] const Eigen::Vector3d& axis(int dof) const { return axis_world_[static_cast<std::size_t>(dof)]; }
  // Analytic d position / d q. Columns of DoFs that do not move the point are zero.
  void jacobian(const BonePoint& point, PointJacobian& J) const;

 private:
  std::array<Eigen::Matrix3d, kBoneCount> R_world_;
  std::array<Eigen::Vector3d, kBoneCount> p_world_;
  std::array<Eigen::Vector3d, kDofCount> axis_world_;  // see axis(); those of translations are undefined
};

// Local rotation of a bone in its parent for q, and the inverse: the bone's DoFs in q from a rotation.
// setLocalRotation returns the residual angle [rad] that the bone's DoFs cannot express (0 for 3-DoF bones).
Eigen::Matrix3d localRotation(Bone bone, const Pose& q);
double setLocalRotation(Bone bone, const Eigen::Matrix3d& R_parent_bone, Pose& q);

// The 18 contract joints in the world [m].
JointPositions jointPositions(const Skeleton& skeleton, const Pose& q);

// q of the mirror image (x -> -x): left and right swapped.
Pose mirroredPose(const Pose& q);

}  // namespace depthmocap
