#include "libtracker/body/pose_surface.h"

#include <array>

#include "libtracker/skeleton/forward_kinematics.h"

namespace depthmocap {
namespace {

struct Rigid {
  Eigen::Matrix3f R;
  Eigen::Vector3f t;
};
using SkinMotion = std::array<Rigid, kSkinBoneCount>;

Rigid aboutJoint(const Eigen::Matrix3d& R, const Eigen::Vector3d& zero_origin, const Eigen::Vector3d& origin) {
  return {R.cast<float>(), (origin - R * zero_origin).cast<float>()};
}

// Motion of every skin bone from the zero pose to q.
SkinMotion skinMotion(const Skeleton& skeleton, const Pose& q) {
  ForwardKinematics zero;
  ForwardKinematics posed;
  zero.update(skeleton, Pose::Zero());
  posed.update(skeleton, q);
  SkinMotion motion;
  for (std::size_t b = 0; b < kBoneCount; ++b) {
    const auto bone = static_cast<Bone>(b);
    motion[b] = aboutJoint(posed.R_world_bone(bone), zero.origin(bone), posed.origin(bone));
  }
  for (const TwistBone& limb : kTwistBones) {
    const Eigen::Matrix3d back = Eigen::AngleAxisd(-q[limb.twist], Eigen::Vector3d::Unit(limb.axis)).toRotationMatrix();
    motion[static_cast<std::size_t>(limb.untwisted)] =
        aboutJoint(posed.R_world_bone(limb.bone) * back, zero.origin(limb.bone), posed.origin(limb.bone));
  }
  return motion;
}

}  // namespace

void poseSurface(const BodySurface& body, const Pose& q, std::vector<Eigen::Vector3f>& vertices) {
  const SkinMotion motion = skinMotion(body.skeleton, q);
  vertices.resize(body.vertices.size());
  for (std::size_t i = 0; i < body.vertices.size(); ++i) {
    const BodySurface::Skin& skin = body.skin[i];
    const Eigen::Vector3f& p = body.vertices[i];
    const Rigid& first = motion[skin.bone[0]];
    if (skin.weight[1] <= 0) {
      vertices[i] = first.R * p + first.t;
      continue;
    }
    Eigen::Matrix3f R = skin.weight[0] * first.R;
    Eigen::Vector3f t = skin.weight[0] * first.t;
    for (std::size_t k = 1; k < 4 && skin.weight[k] > 0; ++k) {
      const Rigid& next = motion[skin.bone[k]];
      R += skin.weight[k] * next.R;
      t += skin.weight[k] * next.t;
    }
    vertices[i] = R * p + t;
  }
}

}  // namespace depthmocap
