#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace depthmocap {

// A round limb: the axis through `point` along `axis` (unit) and its radius, world [m]; it covers the points' extent
// from `low` to `high` along the axis, measured from `point`.
struct Cylinder {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();
  double radius = 0;
  double low = 0, high = 0;
  double inlier_share = 0;  // [0, 1] of the points
};

// A trunk: a cylinder of elliptic section, half axes across and towards the camera.
struct EllipticCylinder {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  // of the section at the points' middle, world [m]
  Eigen::Vector3d axis = Eigen::Vector3d::UnitY();   // unit, upwards
  Eigen::Vector3d side = Eigen::Vector3d::UnitX();   // unit, across, at right angles to the axis
  double half_width = 0;                             // [m] along side
  double half_depth = 0;                             // [m] along side x axis
  double low = 0, high = 0;                          // along the axis from the centre
  double inlier_share = 0;                           // [0, 1] of the points
};

// What of a long body part shows without its curvature, which a noisy depth image hardly has: the line through the
// middles of its outline, and how wide it is.
struct LimbOutline {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();   // mean of the points, moved across to between the outlines
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();    // unit, along the limb
  Eigen::Vector3d across = Eigen::Vector3d::UnitY();  // unit, in the image
  Eigen::Vector3d front = Eigen::Vector3d::UnitZ();   // unit, towards the camera; across x axis
  double half_width = 0;                              // [m]
  double low = 0, high = 0;                           // [m] the points' extent along the axis from the middle
};
// Nothing for fewer than 30 points or a part that is wider than long. `expected_axis`: unit, across the line of sight.
std::optional<LimbOutline> limbOutline(const std::vector<Eigen::Vector3f>& points,
                                       const Eigen::Vector3d& expected_axis);
// From where to where along the axis (unit) the points reach, but for stray ones [m], measured from `origin`. Needs a
// point.
std::pair<double, double> extentAlong(const std::vector<Eigen::Vector3f>& points, const Eigen::Vector3d& axis,
                                      const Eigen::Vector3d& origin);

struct CylinderFitConfig {
  double inlier_m = 0.010;       // [m] (> 0) from the surface, at least
  double inlier_per_m2 = 0.002;  // [1/m] more for the sensor: this times the squared distance, if that is larger
  int iterations = 300;          // (>= 1)
  std::uint64_t seed = 1;
};

// The axis is that of the outline; RANSAC (PCL SACMODEL_CIRCLE2D, least squares over the inliers) finds depth and
// radius of the section, the radius within 20 % of the outline's half width. Points of the side that the camera, the
// origin of the world, sees. Nothing where there are too few points or no cylinder fits half of them.
std::optional<Cylinder> fitCylinder(const std::vector<Eigen::Vector3f>& points, const Eigen::Vector3d& expected_axis,
                                    const CylinderFitConfig& config);

// RANSAC for what PCL has no model of: an ellipse as wide as the outline, whose centre and depth follow from two
// points, then least squares over the inliers. From the front the back is not seen: the depth must be between 0.5 and
// 0.9 of the width. Nothing where no ellipse fits half of the points.
std::optional<EllipticCylinder> fitEllipticCylinder(const std::vector<Eigen::Vector3f>& points,
                                                    const Eigen::Vector3d& expected_axis,
                                                    const CylinderFitConfig& config);

}  // namespace depthmocap
