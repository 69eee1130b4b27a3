#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "calibration/limb_shapes.h"
#include "libtracker/core/random.h"

namespace depthmocap {
namespace {

using Eigen::Vector2d;

constexpr std::size_t kFewestPoints = 60;
constexpr std::size_t kMostPoints = 1500;
constexpr double kLeastShare = 0.5;
constexpr double kFlattest = 0.5;  // half depth over half width of a trunk
constexpr double kRoundest = 0.9;
constexpr double kUsualDepth = 0.7;
constexpr double kDepthDeviation = 0.06;
constexpr double kSampleDeviation_m = 0.01;
constexpr double kIndependent = 20;  // samples of this deviation that all of them count as
// Share of the half width: nearer to the outline a small error of it is a large one of depth.
constexpr double kOutermost = 0.95;

// The front half of an ellipse of known width: front = center + half_depth * roundness(across).
struct Front {
  double center = 0;
  double half_depth = 0;
};

// A point of the section: how far the ellipse bulges there, of its half depth, and how far to the front it lies [m].
struct Sample {
  double roundness = 0;  // [0, 1]
  double front = 0;
};

// The ellipse through two samples, if it is a trunk's.
std::optional<Front> through(const Sample& a, const Sample& b, double half_width) {
  const double half_depth = (a.front - b.front) / (a.roundness - b.roundness);
  const bool believable = half_depth >= kFlattest * half_width && half_depth <= kRoundest * half_width;  // no NaN
  if (!believable) return std::nullopt;
  return Front{a.front - half_depth * a.roundness, half_depth};
}

// Least squares with a usual trunk's depth as a prior. A trunk is no ellipse: all samples together say no more than a
// few independent ones.
Front leastSquares(const std::vector<Sample>& samples, double half_width) {
  double total = 0;
  Eigen::Matrix2d A = Eigen::Matrix2d::Zero();
  Vector2d b = Vector2d::Zero();
  for (const Sample& s : samples) {
    const double weight = 1.0 / s.roundness;  // a pixel covers ever more of the surface towards the outline
    const Vector2d x(1.0, s.roundness);
    A += weight * x * x.transpose();
    b += weight * s.front * x;
    total += weight;
  }
  const double scale = kIndependent / (total * kSampleDeviation_m * kSampleDeviation_m);
  const double prior = 1.0 / std::pow(kDepthDeviation * half_width, 2);
  A = scale * A;
  b = scale * b;
  A(1, 1) += prior;
  b[1] += prior * kUsualDepth * half_width;
  const Vector2d solution = A.ldlt().solve(b);
  return {solution[0], solution[1]};
}

std::vector<Sample> inliersOf(const Front& e, const std::vector<Sample>& samples, double limit) {
  std::vector<Sample> inliers;
  for (const Sample& s : samples) {
    if (std::abs(e.center + e.half_depth * s.roundness - s.front) < limit) inliers.push_back(s);
  }
  return inliers;
}

std::vector<Sample> samplesOf(const std::vector<Eigen::Vector3f>& points, const LimbOutline& outline) {
  std::vector<Sample> samples;
  const std::size_t count = std::min(points.size(), kMostPoints);
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3d p = points[i * points.size() / count].cast<double>() - outline.middle;
    const double share = outline.across.dot(p) / outline.half_width;
    if (std::abs(share) > kOutermost) continue;
    samples.push_back({std::sqrt(1.0 - share * share), outline.front.dot(p)});
  }
  return samples;
}

}  // namespace

std::optional<EllipticCylinder> fitEllipticCylinder(const std::vector<Eigen::Vector3f>& points,
                                                    const Eigen::Vector3d& expected_axis,
                                                    const CylinderFitConfig& config) {
  if (points.size() < kFewestPoints) return std::nullopt;
  const auto outline = limbOutline(points, expected_axis);
  if (!outline) return std::nullopt;
  const double inlier_m = std::max(config.inlier_m, config.inlier_per_m2 * outline->middle.squaredNorm());
  const std::vector<Sample> samples = samplesOf(points, *outline);
  Random random(config.seed);
  std::vector<Sample> best;
  for (int i = 0; i < config.iterations; ++i) {
    const auto draw = [&] { return samples[random.below(static_cast<std::uint32_t>(samples.size()))]; };
    const Sample a = draw();
    const auto front = through(a, draw(), outline->half_width);
    if (!front) continue;
    auto inliers = inliersOf(*front, samples, inlier_m);
    if (inliers.size() > best.size()) best = std::move(inliers);
  }
  EllipticCylinder trunk;
  trunk.inlier_share = static_cast<double>(best.size()) / static_cast<double>(samples.size());
  if (trunk.inlier_share < kLeastShare) return std::nullopt;
  const Front front = leastSquares(best, outline->half_width);
  trunk.axis = outline->axis;
  trunk.side = -outline->across;
  trunk.center = outline->middle + front.center * outline->front;
  trunk.half_width = outline->half_width;
  trunk.half_depth = front.half_depth;
  trunk.low = outline->low;
  trunk.high = outline->high;
  return trunk;
}

}  // namespace depthmocap
