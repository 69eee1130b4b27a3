#include "libtracker/body/sample_surface.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "libtracker/core/random.h"
#include "libtracker/skeleton/forward_kinematics.h"

namespace depthmocap {
namespace {

// The untwisted helpers of the skin move with their bone as far as a rigid point can tell.
Bone boneOfSkin(std::uint8_t skin_bone) {
  switch (skin_bone) {
    case kRightHumerusUntwisted:
      return Bone::RightHumerus;
    case kLeftHumerusUntwisted:
      return Bone::LeftHumerus;
    case kRightFemurUntwisted:
      return Bone::RightFemur;
    case kLeftFemurUntwisted:
      return Bone::LeftFemur;
    default:
      return static_cast<Bone>(skin_bone);
  }
}

// The bone that holds most of a triangle.
Bone boneOfTriangle(const BodySurface& body, const std::array<std::uint32_t, 3>& triangle) {
  std::array<float, kBoneCount> weight{};
  for (std::uint32_t v : triangle) {
    for (std::size_t k = 0; k < 4; ++k) {
      weight[static_cast<std::size_t>(boneOfSkin(body.skin[v].bone[k]))] += body.skin[v].weight[k];
    }
  }
  return static_cast<Bone>(std::max_element(weight.begin(), weight.end()) - weight.begin());
}

}  // namespace

SurfaceModel sampleSurface(const BodySurface& body, int points, std::uint64_t seed) {
  ForwardKinematics rest;
  rest.update(body.skeleton, Pose::Zero());
  double total_area = 0;
  const auto cross = [&](const std::array<std::uint32_t, 3>& t) {
    return Eigen::Vector3f(
        (body.vertices[t[1]] - body.vertices[t[0]]).cross(body.vertices[t[2]] - body.vertices[t[0]]));
  };
  for (const auto& triangle : body.triangles) total_area += 0.5 * static_cast<double>(cross(triangle).norm());

  SurfaceModel model;
  model.stature_m = statureOf(body.skeleton.lengths);
  Random random(seed);
  const double area_per_point = total_area / points;
  double due = random.uniform() * area_per_point;
  for (std::size_t i = 0; i < body.triangles.size(); ++i) {
    const auto& triangle = body.triangles[i];
    const Eigen::Vector3f area = cross(triangle);
    due -= 0.5 * static_cast<double>(area.norm());
    if (due > 0) continue;
    due += area_per_point;
    SurfaceModel::Point point;
    point.bone = boneOfTriangle(body, triangle);
    const Eigen::Vector3f centre =
        (body.vertices[triangle[0]] + body.vertices[triangle[1]] + body.vertices[triangle[2]]) / 3.0F;
    point.p_bone = centre - rest.origin(point.bone).cast<float>();
    point.n_bone = area.normalized();
    const auto part = static_cast<Part>(body.part[i]);
    if (part != Part::None) model.parts[static_cast<std::size_t>(partIndex(part))].push_back(point);
  }
  return model;
}

}  // namespace depthmocap
