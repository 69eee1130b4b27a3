#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <tuple>

#include "calibration/limb_shapes.h"

namespace depthmocap {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr std::size_t kFewestPoints = 30;
constexpr int kSlabs = 8;
constexpr std::size_t kFewestInSlab = 6;
constexpr double kTrimmed = 0.1;  // of a slab's points at each side: stray pixels

constexpr double kTrimmedEnds = 0.01;

// One slab's middle between its outlines and mean depth, and half its width.
struct Slab {
  double along = 0;  // [m] its middle
  double across = 0, front = 0;
  double half_width = 0;
  double weight = 0;  // its share of the points
};

double quantile(std::vector<double>& values, double share) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

std::vector<Slab> slabsOf(const std::vector<Eigen::Vector3f>& points, const Vector3d& along, const Vector3d& across,
                          const Vector3d& front) {
  const auto [low, high] = extentAlong(points, along, Vector3d::Zero());
  std::array<std::vector<double>, kSlabs> sides;
  std::array<double, kSlabs> depth{};
  for (const auto& p : points) {
    const double share = (along.dot(p.cast<double>()) - low) / std::max(high - low, 1e-6);
    if (share < 0 || share > 1) continue;
    const auto k = static_cast<std::size_t>(std::min(kSlabs - 1.0, kSlabs * share));
    sides[k].push_back(across.dot(p.cast<double>()));
    depth[k] += front.dot(p.cast<double>());
  }
  std::vector<Slab> slabs;
  for (std::size_t k = 0; k < kSlabs; ++k) {
    if (sides[k].size() < kFewestInSlab) continue;
    const double right = quantile(sides[k], kTrimmed);
    const double left = quantile(sides[k], 1.0 - kTrimmed);
    // Pixels lie evenly between the outlines.
    slabs.push_back({low + (high - low) * (static_cast<double>(k) + 0.5) / kSlabs, 0.5 * (left + right),
                     depth[k] / static_cast<double>(sides[k].size()), 0.5 * (left - right) / (1.0 - 2.0 * kTrimmed),
                     static_cast<double>(sides[k].size()) / static_cast<double>(points.size())});
  }
  return slabs;
}

}  // namespace

std::pair<double, double> extentAlong(const std::vector<Eigen::Vector3f>& points, const Vector3d& axis,
                                      const Vector3d& origin) {
  std::vector<double> along;
  along.reserve(points.size());
  for (const auto& p : points) along.push_back(axis.dot(p.cast<double>() - origin));
  const double low = quantile(along, kTrimmedEnds);
  return {low, quantile(along, 1.0 - kTrimmedEnds)};
}

std::optional<LimbOutline> limbOutline(const std::vector<Eigen::Vector3f>& points, const Vector3d& expected_axis) {
  if (points.size() < kFewestPoints) return std::nullopt;
  const Vector3d across = expected_axis.cross(Vector3d::UnitZ()).normalized();
  const Vector3d front = across.cross(expected_axis);
  const std::vector<Slab> slabs = slabsOf(points, expected_axis, across, front);
  if (slabs.size() < 3) return std::nullopt;
  Eigen::Matrix2d A = Eigen::Matrix2d::Zero();
  Eigen::Matrix2d b = Eigen::Matrix2d::Zero();
  double total = 0;
  for (const Slab& slab : slabs) total += slab.weight;
  double half_width = 0;
  for (const Slab& slab : slabs) {
    const Vector2d x(1.0, slab.along);
    A += slab.weight * x * x.transpose();
    b += slab.weight * x * Vector2d(slab.across, slab.front).transpose();
    half_width += slab.weight * slab.half_width / total;
  }
  const Eigen::Matrix2d line = A.ldlt().solve(b);
  LimbOutline outline;
  outline.axis = (expected_axis + line(1, 0) * across + line(1, 1) * front).normalized();
  outline.across = outline.axis.cross(Vector3d::UnitZ()).normalized();
  outline.front = outline.across.cross(outline.axis);
  const double cosine = expected_axis.dot(outline.axis);
  outline.half_width = half_width * cosine;
  const double along = 0.5 * (slabs.front().along + slabs.back().along);
  outline.middle =
      along * expected_axis + (line(0, 0) + line(1, 0) * along) * across + (line(0, 1) + line(1, 1) * along) * front;
  std::tie(outline.low, outline.high) = extentAlong(points, outline.axis, outline.middle);
  if (outline.half_width <= 0 || outline.high - outline.low < outline.half_width) return std::nullopt;
  return outline;
}

}  // namespace depthmocap
