#include <algorithm>
#include <limits>

#include <pcl/console/print.h>
#include <pcl/features/normal_3d.h>
#include <pcl/point_types.h>
#include <pcl/sample_consensus/ransac.h>
#include <pcl/sample_consensus/sac_model_cylinder.h>
#include <pcl/search/kdtree.h>

#include "calibration/limb_shapes.h"

namespace depthmocap {
namespace {

constexpr std::size_t kFewestPoints = 30;
constexpr std::size_t kMostPoints = 600;  // more do not change the fit
constexpr int kNormalNeighbours = 30;
constexpr double kNormalWeight = 0.01;  // [m / rad] normals of a noisy depth image help little
constexpr double kLeastShare = 0.5;     // of the points that a believed cylinder explains

using Cloud = pcl::PointCloud<pcl::PointXYZ>;
using Normals = pcl::PointCloud<pcl::Normal>;
using Model = pcl::SampleConsensusModelCylinder<pcl::PointXYZ, pcl::Normal>;

Cloud::Ptr toCloud(const std::vector<Eigen::Vector3f>& points) {
  Cloud::Ptr cloud(new Cloud);
  const std::size_t count = std::min(points.size(), kMostPoints);
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3f& p = points[i * points.size() / count];
    cloud->emplace_back(p.x(), p.y(), p.z());
  }
  return cloud;
}

Normals::Ptr normalsOf(const Cloud::Ptr& cloud) {
  pcl::NormalEstimation<pcl::PointXYZ, pcl::Normal> estimation;
  estimation.setInputCloud(cloud);
  estimation.setSearchMethod(pcl::search::KdTree<pcl::PointXYZ>::Ptr(new pcl::search::KdTree<pcl::PointXYZ>));
  estimation.setKSearch(kNormalNeighbours);
  estimation.setViewPoint(0, 0, 0);
  Normals::Ptr normals(new Normals);
  estimation.compute(*normals);
  return normals;
}

Cylinder fromCoefficients(const Eigen::VectorXf& c, const Eigen::Vector3d& expected_axis, const Cloud& cloud) {
  Cylinder cylinder;
  cylinder.point = c.head<3>().cast<double>();
  cylinder.axis = c.segment<3>(3).cast<double>().normalized();
  if (cylinder.axis.dot(expected_axis) < 0) cylinder.axis = -cylinder.axis;
  cylinder.radius = static_cast<double>(c[6]);
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const auto& p : cloud) mean += p.getVector3fMap().cast<double>() / static_cast<double>(cloud.size());
  cylinder.point += cylinder.axis * cylinder.axis.dot(mean - cylinder.point);
  cylinder.low = std::numeric_limits<double>::max();
  cylinder.high = std::numeric_limits<double>::lowest();
  for (const auto& p : cloud) {
    const double t = cylinder.axis.dot(p.getVector3fMap().cast<double>() - cylinder.point);
    cylinder.low = std::min(cylinder.low, t);
    cylinder.high = std::max(cylinder.high, t);
  }
  return cylinder;
}

}  // namespace

std::optional<Cylinder> fitCylinder(const std::vector<Eigen::Vector3f>& points, const Eigen::Vector3d& expected_axis,
                                    const CylinderFitConfig& config) {
  if (points.size() < kFewestPoints) return std::nullopt;
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);  // a limb without a cylinder is no news
  const Cloud::Ptr cloud = toCloud(points);
  const Model::Ptr model(new Model(cloud, false));  // not random: PCL's own fixed seed
  model->setInputNormals(normalsOf(cloud));
  model->setNormalDistanceWeight(kNormalWeight);
  model->setRadiusLimits(config.min_radius_m, config.max_radius_m);
  model->setAxis(expected_axis.cast<float>());
  model->setEpsAngle(config.max_axis_tilt);
  pcl::RandomSampleConsensus<pcl::PointXYZ> ransac(model, config.inlier_m);
  ransac.setMaxIterations(config.iterations);
  ransac.setProbability(0.999);
  if (!ransac.computeModel()) return std::nullopt;
  Eigen::VectorXf coefficients;
  ransac.getModelCoefficients(coefficients);
  pcl::Indices inliers;
  model->selectWithinDistance(coefficients, config.inlier_m, inliers);
  const double share = static_cast<double>(inliers.size()) / static_cast<double>(cloud->size());
  if (share < kLeastShare) return std::nullopt;
  Eigen::VectorXf refined;
  model->optimizeModelCoefficients(inliers, coefficients, refined);
  const bool usable = refined.size() == 7 && refined.allFinite() &&
                      static_cast<double>(refined[6]) >= config.min_radius_m &&
                      static_cast<double>(refined[6]) <= config.max_radius_m;
  Cylinder cylinder = fromCoefficients(usable ? refined : coefficients, expected_axis, *cloud);
  cylinder.inlier_share = share;
  return cylinder;
}

}  // namespace depthmocap
