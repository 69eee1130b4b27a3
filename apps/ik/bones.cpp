#include "apps/ik/bones.h"

#include <Eigen/Geometry>
#include <vector>

#include "apps/ik/json_numbers.h"
#include "libtracker/motion/rig.h"
#include "libtracker/output/rig_nodes.h"
#include "libtracker/skeleton/forward_kinematics.h"

namespace depthmocap {
namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using nlohmann::json;

// Our world, y up, facing +z, to Blender's, z up, facing -y.
Matrix3d blenderFromOurs() {
  return (Matrix3d() << 1, 0, 0, 0, 0, -1, 0, 1, 0).finished();
}

json gltfBones(const Skeleton& skeleton, const Pose& q) {
  const RigNodes rig(RigStyle::MotionBuilder, skeleton);
  const std::vector<RigNodes::Node>& nodes = rig.nodes();
  json bones;
  for (const RigNodes::Node& node : nodes) {
    bones[node.name] = {{"translation", listOf(node.parent < 0 ? Vector3d(q.head<3>()) : node.offset)},
                        {"rotation", {0.0, 0.0, 0.0, 1.0}}};
    if (node.parent >= 0) bones[node.name]["parent"] = nodes[static_cast<std::size_t>(node.parent)].name;
  }
  for (int b = 0; b < kSkinBoneCount; ++b) {
    const Quaterniond r = rig.rotation(b, q);
    bones[nodes[static_cast<std::size_t>(rig.nodeOf(b))].name]["rotation"] = {rounded(r.x()), rounded(r.y()),
                                                                              rounded(r.z()), rounded(r.w())};
  }
  return bones;
}

// The bone that goes on where this one ends; a spine goes on in the neck, not in a clavicle.
std::size_t nextBone(const std::vector<MotionBone>& bones, std::size_t bone) {
  if (bone == static_cast<std::size_t>(Bone::UpperBack)) return static_cast<std::size_t>(Bone::Neck);
  for (std::size_t next = bone + 1; next < bones.size(); ++next) {
    if (bones[next].parent == static_cast<int>(bone)) return next;
  }
  return bone;
}

// A bone's axes at rest, in Blender's world: y along the bone, z as near as may be to where the body faces, or up for
// feet and toes, which point there.
Matrix3d restAxes(const Vector3d& along) {
  const Vector3d y = along.normalized();
  const Vector3d forward(0, -1, 0);
  const bool points_forward = y.dot(forward) > 0.7;  // 45 degrees, beyond which "forward" says little of the roll
  const Vector3d wanted = points_forward ? Vector3d::UnitZ() : forward;
  const Vector3d z = (wanted - wanted.dot(y) * y).normalized();
  return (Matrix3d() << y.cross(z), y, z).finished();
}

json blenderBones(const Skeleton& skeleton, const Pose& q) {
  const Rig rig(RigStyle::MotionBuilder, skeleton);
  const std::vector<MotionBone>& bones = rig.bones();
  const Matrix3d turn = blenderFromOurs();
  std::vector<Vector3d> head(bones.size());
  for (std::size_t b = 0; b < bones.size(); ++b) {
    head[b] = turn * bones[b].offset;
    if (bones[b].parent >= 0) head[b] += head[static_cast<std::size_t>(bones[b].parent)];
  }
  json list;
  for (std::size_t b = 0; b < bones.size(); ++b) {
    const Vector3d tail = bones[b].has_tip ? Vector3d(head[b] + turn * bones[b].tip) : head[nextBone(bones, b)];
    const Matrix3d rest = restAxes(tail - head[b]);
    const Matrix3d local = b < kBoneCount ? localRotation(static_cast<Bone>(b), q) : Matrix3d::Identity();
    const Quaterniond r(rest.transpose() * turn * local * turn.transpose() * rest);
    const Vector3d location = b == 0 ? Vector3d(rest.transpose() * (turn * q.head<3>() - head[b])) : Vector3d::Zero();
    json& bone = list[bones[b].name];
    bone = {{"head", listOf(head[b])},
            {"tail", listOf(tail)},
            {"z_axis", listOf(rest.col(2))},
            {"location", listOf(location)},
            {"rotation_quaternion", {rounded(r.w()), rounded(r.x()), rounded(r.y()), rounded(r.z())}}};
    if (bones[b].parent >= 0) bone["parent"] = bones[static_cast<std::size_t>(bones[b].parent)].name;
  }
  return list;
}

}  // namespace

json bonesOf(BoneConvention convention, const Skeleton& skeleton, const Pose& q) {
  return convention == BoneConvention::Gltf ? gltfBones(skeleton, q) : blenderBones(skeleton, q);
}

}  // namespace depthmocap
