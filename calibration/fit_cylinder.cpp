#include <algorithm>
#include <cmath>

#include <pcl/console/print.h>
#include <pcl/point_types.h>
#include <pcl/sample_consensus/ransac.h>
#include <pcl/sample_consensus/sac_model_circle.h>

#include "calibration/limb_shapes.h"

namespace depthmocap {
namespace {

constexpr std::size_t kMostPoints = 1000;  // more do not change the fit
constexpr double kLeastShare = 0.5;        // of the points that a believed cylinder explains
constexpr double kLeastWidth = 0.8;        // radius over the outline's half width
constexpr double kMostWidth = 1.2;
constexpr int kRefinements = 3;

using Cloud = pcl::PointCloud<pcl::PointXYZ>;
using Circle = pcl::SampleConsensusModelCircle2D<pcl::PointXYZ>;

// The points as seen along the axis: across and towards the camera, from the outline's middle. Each with its mirror
// image about that middle, so that noise in depth does not move the section to one side.
Cloud::Ptr sectionOf(const std::vector<Eigen::Vector3f>& points, const LimbOutline& outline) {
  Cloud::Ptr section(new Cloud);
  const std::size_t count = std::min(points.size(), kMostPoints);
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3d p = points[i * points.size() / count].cast<double>() - outline.middle;
    const auto across = static_cast<float>(outline.across.dot(p));
    const auto front = static_cast<float>(outline.front.dot(p));
    section->emplace_back(across, front, 0.0F);
    section->emplace_back(-across, front, 0.0F);
  }
  return section;
}

// Least squares over the inliers, as long as the radius stays within its limits.
void refine(Circle& model, double inlier_m, Eigen::VectorXf& circle, pcl::Indices& inliers) {
  for (int i = 0; i < kRefinements; ++i) {
    Eigen::VectorXf better;
    model.optimizeModelCoefficients(inliers, circle, better);
    pcl::Indices next;
    model.selectWithinDistance(better, inlier_m, next);  // none outside the limits
    if (next.size() < inliers.size() / 2) return;
    circle = better;
    inliers = std::move(next);
  }
}

}  // namespace

std::optional<Cylinder> fitCylinder(const std::vector<Eigen::Vector3f>& points, const Eigen::Vector3d& expected_axis,
                                    const CylinderFitConfig& config) {
  const auto outline = limbOutline(points, expected_axis);
  if (!outline) return std::nullopt;
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);  // a limb without a cylinder is no news
  const double inlier_m = std::max(config.inlier_m, config.inlier_per_m2 * outline->middle.squaredNorm());
  const Cloud::Ptr section = sectionOf(points, *outline);
  const Circle::Ptr model(new Circle(section, false));  // not random: PCL's own fixed seed
  model->setRadiusLimits(kLeastWidth * outline->half_width, kMostWidth * outline->half_width);
  pcl::RandomSampleConsensus<pcl::PointXYZ> ransac(model, inlier_m);
  ransac.setMaxIterations(config.iterations);
  ransac.setProbability(0.999);
  if (!ransac.computeModel()) return std::nullopt;
  Eigen::VectorXf circle;
  ransac.getModelCoefficients(circle);
  pcl::Indices inliers;
  ransac.getInliers(inliers);
  refine(*model, inlier_m, circle, inliers);
  Cylinder cylinder;
  cylinder.inlier_share = static_cast<double>(inliers.size()) / static_cast<double>(section->size());
  if (cylinder.inlier_share < kLeastShare) return std::nullopt;
  cylinder.axis = outline->axis;
  cylinder.point = outline->middle + static_cast<double>(circle[0]) * outline->across +
                   static_cast<double>(circle[1]) * outline->front;
  cylinder.radius = static_cast<double>(circle[2]);
  cylinder.low = outline->low;
  cylinder.high = outline->high;
  return cylinder;
}

}  // namespace depthmocap
