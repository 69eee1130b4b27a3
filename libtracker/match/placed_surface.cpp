#include "libtracker/match/placed_surface.h"

namespace depthmocap {
namespace {

constexpr float kMinFacing = 0.15F;  // cosine between normal and ray to the camera of a point that counts as seen

}  // namespace

void PlacedSurface::place(const SurfaceModel& surface, double scale, const ForwardKinematics& fk) {
  std::array<Eigen::Matrix3f, kBoneCount> R;
  std::array<Eigen::Vector3f, kBoneCount> t;
  for (std::size_t b = 0; b < kBoneCount; ++b) {
    R[b] = fk.R_world_bone(static_cast<Bone>(b)).cast<float>();
    t[b] = fk.origin(static_cast<Bone>(b)).cast<float>();
  }
  const auto size = static_cast<float>(scale);
  points.clear();
  for (std::size_t part = 0; part < kPartCount; ++part) {
    parts[part].clear();
    for (const SurfaceModel::Point& point : surface.parts[part]) {
      const auto b = static_cast<std::size_t>(point.bone);
      const Eigen::Vector3f p_bone = size * point.p_bone;
      const Eigen::Vector3f p = R[b] * p_bone + t[b];
      const Eigen::Vector3f n = R[b] * point.n_bone;
      if (-n.dot(p) <= kMinFacing * p.norm()) continue;
      parts[part].push_back({p, n, {point.bone, p_bone.cast<double>()}});
      points.add(part, p);
    }
  }
  points.finish();
}

}  // namespace depthmocap
