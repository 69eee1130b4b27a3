#include "calibration/fit_limbs.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

namespace depthmocap {
namespace {

using Eigen::Vector3d;

constexpr double kSurfaceScale_m = 0.02;  // a fit this far from the cloud counts 1/e
constexpr double kLeastGirthShare = 0.6;  // of that of the stature: a cylinder outside is not believed as a start
constexpr double kMostGirthShare = 1.7;
constexpr double kTrunkShare = 0.6;  // of the torso's height that lies below the armpits

constexpr std::pair<Part, Girth> kLimbs[] = {{Part::LeftUpperArm, Girth::UpperArm},
                                             {Part::LeftLowerArm, Girth::LowerArm},
                                             {Part::LeftUpperLeg, Girth::UpperLeg},
                                             {Part::LeftLowerLeg, Girth::LowerLeg}};

bool isArm(Part part) {
  return part == Part::LeftUpperArm || part == Part::RightUpperArm || part == Part::LeftLowerArm ||
         part == Part::RightLowerArm;
}

const std::optional<Cylinder>& cylinderOf(const FittedLimbs& limbs, Part part) {
  return limbs.cylinders[static_cast<std::size_t>(partIndex(part))];
}

// Mean of both sides by their share of inliers; 0 where neither was fitted.
double sharedRadius(const FittedLimbs& limbs, Part part) {
  double sum = 0;
  double weight = 0;
  for (const Part side : {part, mirrored(part)}) {
    const auto& cylinder = cylinderOf(limbs, side);
    if (!cylinder) continue;
    sum += cylinder->inlier_share * cylinder->radius;
    weight += cylinder->inlier_share;
  }
  return weight > 0 ? sum / weight : 0.0;
}

// A part's points of all frames, moved so that their middle is that of the first.
std::vector<Eigen::Vector3f> overlaid(const std::vector<std::vector<CloudPoint>>& clouds, Part part) {
  std::vector<Eigen::Vector3f> all;
  Eigen::Vector3f first = Eigen::Vector3f::Zero();
  for (const auto& cloud : clouds) {
    std::vector<Eigen::Vector3f> points = pointsOf(cloud, part);
    if (points.empty()) continue;
    const Eigen::Vector3f middle =
        std::accumulate(points.begin(), points.end(), Eigen::Vector3f(Eigen::Vector3f::Zero())) /
        static_cast<float>(points.size());
    if (all.empty()) first = middle;
    for (Eigen::Vector3f& p : points) all.push_back(p + first - middle);
  }
  return all;
}

// The points of a limb without hand, foot or what blends into the next part.
std::vector<Eigen::Vector3f> shaft(std::vector<Eigen::Vector3f> points, Part part, const Vector3d& axis) {
  if (points.size() < 10) return {};
  const bool has_end = part == Part::LeftLowerArm || part == Part::RightLowerArm || part == Part::LeftLowerLeg ||
                       part == Part::RightLowerLeg;
  std::sort(points.begin(), points.end(), [&](const auto& a, const auto& b) {
    return axis.dot(a.template cast<double>()) < axis.dot(b.template cast<double>());
  });
  const double low = axis.dot(points.front().cast<double>());
  const double high = axis.dot(points.back().cast<double>());
  const double cut_low = low + 0.08 * (high - low);
  const double cut_high = high - (has_end ? 0.35 : 0.08) * (high - low);
  std::erase_if(points, [&](const auto& p) {
    const double t = axis.dot(p.template cast<double>());
    return t < cut_low || t > cut_high;
  });
  return points;
}

// The trunk below the armpits, where it is as wide as its outline.
std::vector<Eigen::Vector3f> belowArmpits(std::vector<Eigen::Vector3f> points) {
  if (points.empty()) return points;
  const auto [low, high] = extentAlong(points, Vector3d::UnitY(), Vector3d::Zero());
  const double cut = low + kTrunkShare * (high - low);
  std::erase_if(points, [&](const auto& p) { return static_cast<double>(p.y()) > cut; });
  return points;
}

// Root mean square distance of the template's points of a part from its bone, which is what a cylinder would measure.
double templateRadius(const BodyTemplate& body, Part part) {
  double sum = 0;
  int count = 0;
  for (const BodyTemplate::Point& point : body.points()) {
    if (point.part != part) continue;
    const bool along_x = isArm(part);
    const bool shaft = part != Part::LeftLowerArm ? part != Part::LeftLowerLeg || point.bone == Bone::LeftTibia
                                                  : point.p0.x() < boneLengths(body.templateShape()).lower_arm;
    if (!shaft) continue;
    sum += point.p0.z() * point.p0.z() + (along_x ? point.p0.y() * point.p0.y() : point.p0.x() * point.p0.x());
    ++count;
  }
  return count > 0 ? std::sqrt(sum / count) : 0.0;
}

}  // namespace

FittedLimbs fitLimbs(const std::vector<std::vector<CloudPoint>>& clouds, const BodyOutline& outline) {
  FittedLimbs limbs;
  const Vector3d left = (outline.left_hand - outline.right_hand).normalized();
  const Vector3d down = -Vector3d::UnitY();
  CylinderFitConfig config;
  for (const auto& limb : kLimbs) {
    for (const Part part : {limb.first, mirrored(limb.first)}) {
      const bool is_left = part == limb.first;
      const Vector3d axis = isArm(part) ? Vector3d(is_left ? left : -left) : down;
      limbs.cylinders[static_cast<std::size_t>(partIndex(part))] =
          fitCylinder(shaft(overlaid(clouds, part), part, axis), axis, config);
    }
  }
  const std::vector<Eigen::Vector3f> torso = overlaid(clouds, Part::Torso);
  limbs.torso = fitEllipticCylinder(belowArmpits(torso), Vector3d::UnitY(), config);
  if (limbs.torso)
    std::tie(limbs.torso->low, limbs.torso->high) = extentAlong(torso, limbs.torso->axis, limbs.torso->center);
  return limbs;
}

ShapeVector startShape(const BodyTemplate& body, const BodyOutline& outline, const FittedLimbs& limbs) {
  const double stature = outline.height();
  const double girth = body.girthOf(stature);
  const double scale = stature / statureOf(boneLengths(body.templateShape()));
  ShapeVector shape = shapeVector(boneLengths(body.templateShape()).scaled(scale), girth);
  for (const auto& [part, which] : kLimbs) {
    const double radius = sharedRadius(limbs, part);
    const double of_template = templateRadius(body, part);
    if (radius <= 0 || of_template <= 0) continue;
    shape[kBoneLengthCount + static_cast<int>(which)] =
        std::clamp(radius / of_template, kLeastGirthShare * girth, kMostGirthShare * girth);
  }
  return shape;
}

void setRadii(const FittedLimbs& limbs, ActorMeasurement& measured) {
  measured.upper_arm_radius_m = sharedRadius(limbs, Part::LeftUpperArm);
  measured.lower_arm_radius_m = sharedRadius(limbs, Part::LeftLowerArm);
  measured.upper_leg_radius_m = sharedRadius(limbs, Part::LeftUpperLeg);
  measured.lower_leg_radius_m = sharedRadius(limbs, Part::LeftLowerLeg);
  if (!limbs.torso) return;
  measured.torso_half_width_m = limbs.torso->half_width;
  measured.torso_half_depth_m = limbs.torso->half_depth;
}

double fitConfidence(const JointSolution& solution) {
  return std::clamp(solution.matched_share * std::exp(-std::pow(solution.rms_surface_m / kSurfaceScale_m, 2)), 0.0,
                    1.0);
}

}  // namespace depthmocap
