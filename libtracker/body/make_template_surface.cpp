#include "libtracker/body/make_template_surface.h"

#include <algorithm>
#include <cstdint>

#include "libtracker/body/builtin_body.h"
#include "libtracker/body/sample_surface.h"
#include "libtracker/skeleton/forward_kinematics.h"

namespace depthmocap {
namespace {

using Eigen::Vector3d;

constexpr std::uint64_t kSurfaceSeed = 1;
// Points of a shipped surface: the tracker's dense term looks at a few hundred of them per frame.
constexpr int kShippedPoints = 1500;
constexpr double kManStature_m = 1.75;  // of the templates; a template is stretched to every other stature
constexpr double kWomanStature_m = 1.62;
constexpr double kBodyMassIndex = 23.0;  // [kg/m2] of the templates: ordinary weight

BodyShape ordinaryBody(Sex sex) {
  BodyShape shape;
  shape.sex = sex;
  shape.stature_m = sex == Sex::Male ? kManStature_m : kWomanStature_m;
  shape.weight_kg = kBodyMassIndex * shape.stature_m * shape.stature_m;
  return shape;
}

// The outermost vertices of head, hands and feet.
std::array<TemplateSurface::End, TemplateSurface::kEndCount> endsOf(const BodySurface& body) {
  ForwardKinematics rest;
  rest.update(body.skeleton, Pose::Zero());
  const auto outermost = [&](Bone bone, Part part, const Eigen::Vector3f& direction) {
    const auto reach = [&](const Eigen::Vector3f& v) { return direction.dot(v); };
    const auto best = std::max_element(body.vertices.begin(), body.vertices.end(),
                                       [&](const auto& a, const auto& b) { return reach(a) < reach(b); });
    return TemplateSurface::End{bone, part, best->cast<double>() - rest.origin(bone), direction.cast<double>()};
  };
  const TemplateSurface::End crown = outermost(Bone::Head, Part::Head, {0, 1, 0});
  // The sole lies below the toes, where a camera sees the foot end.
  const auto sole = [&](Bone bone, Part part, double side) {
    const double floor_y = -statureOf(body.skeleton.lengths) + rest.origin(Bone::Head).y() + crown.p.y();
    const Vector3d toe = rest.position({bone, side > 0 ? body.skeleton.left_toe : body.skeleton.right_toe});
    return TemplateSurface::End{bone, part, Vector3d(toe.x(), floor_y, toe.z()) - rest.origin(bone),
                                -Vector3d::UnitY()};
  };
  return {crown, outermost(Bone::LeftRadius, Part::LeftLowerArm, {1, 0, 0}),
          outermost(Bone::RightRadius, Part::RightLowerArm, {-1, 0, 0}), sole(Bone::LeftFoot, Part::LeftLowerLeg, 1.0),
          sole(Bone::RightFoot, Part::RightLowerLeg, -1.0)};
}

TemplateSurface sampled(const BodySurface& body, int points) {
  return {body.skeleton.lengths, sampleSurface(body, points, kSurfaceSeed), endsOf(body)};
}

}  // namespace

TemplateSurface makeTemplateSurface(Sex sex, int points) {
  return sampled(makeBuiltinBody(ordinaryBody(sex)), points);
}

ShippedBodies makeShippedBodies() {
  return {sampled(makeBuiltinBody(BodyShape{}), kShippedPoints), makeTemplateSurface(Sex::Male, kShippedPoints),
          makeTemplateSurface(Sex::Female, kShippedPoints)};
}

}  // namespace depthmocap
