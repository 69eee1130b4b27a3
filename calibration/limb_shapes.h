#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <optional>
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

// A trunk: an upright cylinder of elliptic section, half axes across and towards the camera.
struct EllipticCylinder {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  // of the section at the points' middle height, world [m]
  Eigen::Vector3d axis = Eigen::Vector3d::UnitY();   // unit, upwards
  Eigen::Vector3d side = Eigen::Vector3d::UnitX();   // unit, across
  double half_width = 0;                             // [m] along side
  double half_depth = 0;                             // [m] along side x axis
  double low = 0, high = 0;                          // along the axis from the centre
  double inlier_share = 0;
};

struct CylinderFitConfig {
  double min_radius_m = 0.02;   // [m]
  double max_radius_m = 0.16;   // [m] of a trunk twice as much
  double inlier_m = 0.015;      // [m] from the surface
  double max_axis_tilt = 0.45;  // [rad] of the axis from the expected one
  int iterations = 300;
  std::uint64_t seed = 1;
};

// RANSAC (PCL SACMODEL_CYLINDER with normals, radius and axis within the bounds, least squares over the inliers).
// Points of the side that the camera, the origin of the world, sees. Nothing where there are too few points or no
// cylinder fits half of them.
std::optional<Cylinder> fitCylinder(const std::vector<Eigen::Vector3f>& points, const Eigen::Vector3d& expected_axis,
                                    const CylinderFitConfig& config);

// RANSAC for what PCL has no model of: with the axis given, the section is an ellipse with half axes along `side` and
// across, through random samples of the points , then least squares over the
// inliers. The depth is between 0.45 and 1.1 of the width. Nothing where no ellipse fits half of the points.
std::optional<EllipticCylinder> fitEllipticCylinder(const std::vector<Eigen::Vector3f>& points,
                                                    const Eigen::Vector3d& axis, const Eigen::Vector3d& side,
                                                    const CylinderFitConfig& config);

}  // namespace depthmocap
