#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "calibration/limb_shapes.h"
#include "libtracker/core/random.h"

namespace depthmocap {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr std::size_t kFewestPoints = 60;
constexpr std::size_t kMostPoints = 600;
constexpr std::size_t kSample = 6;
constexpr double kLeastShare = 0.5;
constexpr double kFlattest = 0.45;  // half depth over half width of a trunk
constexpr double kRoundest = 1.10;

// (x - x0)^2 / a^2 + (z - z0)^2 / b^2 = 1
struct Ellipse {
  Vector2d center = Vector2d::Zero();
  double a = 0, b = 0;
};

// Signed distance to first order (Sampson).
double distanceTo(const Ellipse& e, const Vector2d& p) {
  const Vector2d d = p - e.center;
  const Vector2d scaled(d.x() / (e.a * e.a), d.y() / (e.b * e.b));
  return 0.5 * (d.dot(scaled) - 1.0) / std::max(scaled.norm(), 1e-9);
}

// Least squares of x^2 + B z^2 + C x + D z + E = 0 about the points' mean.
std::optional<Ellipse> throughPoints(const std::vector<Vector2d>& points, double max_half_width) {
  Vector2d mean = Vector2d::Zero();
  for (const Vector2d& p : points) mean += p / static_cast<double>(points.size());
  Eigen::MatrixX4d A(points.size(), 4);
  Eigen::VectorXd rhs(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector2d p = points[i] - mean;
    const auto row = static_cast<Eigen::Index>(i);
    A.row(row) << p.y() * p.y(), p.x(), p.y(), 1.0;
    rhs[row] = -p.x() * p.x();
  }
  const Eigen::Vector4d c = A.colPivHouseholderQr().solve(rhs);
  if (!c.allFinite() || c[0] <= 0) return std::nullopt;
  Ellipse e;
  e.center = {-0.5 * c[1], -0.5 * c[2] / c[0]};
  const double a2 = e.center.x() * e.center.x() + c[0] * e.center.y() * e.center.y() - c[3];
  if (a2 <= 0) return std::nullopt;
  e.a = std::sqrt(a2);
  e.b = std::sqrt(a2 / c[0]);
  e.center += mean;
  const double flatness = e.b / e.a;
  if (e.a > max_half_width || flatness < kFlattest || flatness > kRoundest) return std::nullopt;
  return e;
}

std::vector<Vector2d> inliersOf(const Ellipse& e, const std::vector<Vector2d>& points, double limit) {
  std::vector<Vector2d> inliers;
  for (const Vector2d& p : points) {
    if (std::abs(distanceTo(e, p)) < limit) inliers.push_back(p);
  }
  return inliers;
}

}  // namespace

std::optional<EllipticCylinder> fitEllipticCylinder(const std::vector<Eigen::Vector3f>& points, const Vector3d& axis,
                                                    const Vector3d& side, const CylinderFitConfig& config) {
  if (points.size() < kFewestPoints) return std::nullopt;
  const Vector3d front = side.cross(axis);
  const std::size_t count = std::min(points.size(), kMostPoints);
  std::vector<Vector2d> section;
  Vector3d mean = Vector3d::Zero();
  for (std::size_t i = 0; i < count; ++i) {
    const Vector3d p = points[i * points.size() / count].cast<double>();
    section.emplace_back(side.dot(p), front.dot(p));
    mean += p / static_cast<double>(count);
  }
  Random random(config.seed);
  std::vector<Vector2d> best;
  std::vector<Vector2d> sample(kSample);
  for (int i = 0; i < config.iterations; ++i) {
    for (Vector2d& p : sample) p = section[random.below(static_cast<std::uint32_t>(section.size()))];
    const auto ellipse = throughPoints(sample, 2.0 * config.max_radius_m);
    if (!ellipse) continue;
    auto inliers = inliersOf(*ellipse, section, config.inlier_m);
    if (inliers.size() > best.size()) best = std::move(inliers);
  }
  const double share = static_cast<double>(best.size()) / static_cast<double>(section.size());
  if (share < kLeastShare) return std::nullopt;
  const auto ellipse = throughPoints(best, 2.0 * config.max_radius_m);
  if (!ellipse) return std::nullopt;
  EllipticCylinder result;
  result.axis = axis;
  result.side = side;
  result.center = side * ellipse->center.x() + front * ellipse->center.y() + axis * axis.dot(mean);
  result.half_width = ellipse->a;
  result.half_depth = ellipse->b;
  result.inlier_share = share;
  for (const auto& p : points) {
    const double t = axis.dot(p.cast<double>() - result.center);
    result.low = std::min(result.low, t);
    result.high = std::max(result.high, t);
  }
  return result;
}

}  // namespace depthmocap
