#include "libtracker/segment/find_floor.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include <pcl/ModelCoefficients.h>
#include <pcl/PointIndices.h>
#include <pcl/console/print.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/segmentation/sac_segmentation.h>

#include "libtracker/segment/surface_normals.h"

namespace depthmocap {

namespace {

// Chosen by hand: no comparison of values is on record (docs/tuning.md).
// Exceptions are kMaxPoints and kMaxIterations: 3000 and 150 gave no better planes, but frames above 10 ms.

// [rad] The promise of Segmenter: the camera is upright within 30 degrees.
constexpr double kMaxTilt_rad = 30.0 * std::numbers::pi / 180.0;
// Least cosine between a floor cell's normal and the assumed up: 40 degrees, which are kMaxTilt_rad and noise.
constexpr float kFloorNormal = 0.77F;
// [points] Most that RANSAC looks at, spread evenly.
constexpr int kMaxPoints = 2000;
// [samples] Most that RANSAC draws for one plane.
constexpr int kMaxIterations = 100;
// Planes tried downwards, each below the one before: a table, a platform, the floor.
constexpr int kMaxFloorTries = 3;
// Rounds of least squares that refine RANSAC's plane.
constexpr int kSettleRounds = 3;
// Least cosine between a cell's normal and the floor's while refining: 22 degrees; in corners it is less.
constexpr float kOnFloor = 0.93F;
// Least share of the measured cells that makes a floor.
constexpr double kMinFloorShare = 0.02;
// [m] Least height of the camera above the floor.
constexpr float kMinCameraHeight_m = 0.2F;
// [m^2] Least area in view of a floor: a sofa's arm or a stool has less.
constexpr float kMinFloorArea_m2 = 0.25F;
// Share of the measured cells that may lie below a floor: reflections and noise.
constexpr double kMaxBelowShare = 0.03;
// Logarithm of the odds from which the room classifier's floor, wall or ceiling may be floor: in doubt, too.
constexpr float kMinShell = -1.0F;
// Least cosine between a cell's normal and the plane that it belongs to: 32 degrees.
constexpr float kAlongPlane = 0.85F;
// [m] Distance of RANSAC's inliers from the plane: about two standard deviations of the noise at 3 m.
constexpr double kFitDistance_m = 0.03;
using PclCloud = pcl::PointCloud<pcl::PointXYZ>;

float distanceTo(const Eigen::Vector4f& plane, const Eigen::Vector3f& p) {
  return plane.head<3>().dot(p) + plane[3];
}

}  // namespace

struct FloorFinder::Impl {
  std::vector<Eigen::Vector3f> normals;
  std::vector<std::size_t> candidates;
  PclCloud::Ptr points = std::make_shared<PclCloud>();
  pcl::PointIndices inliers;
  pcl::ModelCoefficients coefficients;

  template <typename Accept>
  void collect(const CoarseCloud& cloud, Accept&& accept);
  bool fit(const CoarseCloud& cloud, const Eigen::Vector3f& up, Eigen::Vector4f& plane);
  std::optional<Eigen::Vector4f> findLowest(const CoarseCloud& cloud, const std::vector<float>& shell,
                                            double distance_m);
  [[nodiscard]] double shareBelow(const CoarseCloud& cloud, const Eigen::Vector4f& floor, double distance_m) const;
  void settle(const CoarseCloud& cloud, double distance_m, Eigen::Vector4f& floor) const;
  [[nodiscard]] float areaOf(const CoarseCloud& cloud, const Eigen::Vector4f& floor, double distance_m) const;
};

FloorFinder::FloorFinder() : impl_(std::make_unique<Impl>()) {
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);  // PCL prints warnings about samples; libraries do not print
}
FloorFinder::~FloorFinder() = default;

template <typename Accept>
void FloorFinder::Impl::collect(const CoarseCloud& cloud, Accept&& accept) {
  candidates.clear();
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    if (cloud.points[i].z() > 0 && normals[i].squaredNorm() > 0 && accept(i)) candidates.push_back(i);
  }
}

bool FloorFinder::Impl::fit(const CoarseCloud& cloud, const Eigen::Vector3f& up, Eigen::Vector4f& plane) {
  const std::size_t step = (candidates.size() + kMaxPoints - 1) / kMaxPoints;
  points->clear();
  for (std::size_t k = 0; k < candidates.size(); k += step) {
    const Eigen::Vector3f& p = cloud.points[candidates[k]];
    points->push_back(pcl::PointXYZ(p.x(), p.y(), p.z()));
  }
  if (points->size() < 50) return false;
  pcl::SACSegmentation<pcl::PointXYZ> segmentation(false);  // false: PCL's fixed seed
  segmentation.setModelType(pcl::SACMODEL_PERPENDICULAR_PLANE);
  segmentation.setMethodType(pcl::SAC_RANSAC);
  segmentation.setOptimizeCoefficients(true);
  segmentation.setMaxIterations(kMaxIterations);
  segmentation.setDistanceThreshold(kFitDistance_m);
  segmentation.setAxis(up);
  segmentation.setEpsAngle(kMaxTilt_rad);
  segmentation.setInputCloud(points);
  segmentation.segment(inliers, coefficients);
  if (inliers.indices.size() < 50 || coefficients.values.size() != 4) return false;
  plane = Eigen::Map<const Eigen::Vector4f>(coefficients.values.data());
  plane /= plane.head<3>().norm();
  if (plane[3] < 0) plane = -plane;  // the normal points to the camera's side
  return plane.allFinite();
}

// RANSAC's plane rests on few points: least squares over all candidates near it, weighted by what noise allows.
void FloorFinder::Impl::settle(const CoarseCloud& cloud, double distance_m, Eigen::Vector4f& floor) const {
  for (int round = 0; round < kSettleRounds; ++round) {
    double total = 0;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
    for (const std::size_t i : candidates) {
      const float tolerance = floorTolerance(distance_m, floor, cloud.points[i].z());
      if (std::abs(distanceTo(floor, cloud.points[i])) > tolerance || normals[i].dot(floor.head<3>()) < kOnFloor)
        continue;
      const Eigen::Vector3d p = cloud.points[i].cast<double>();
      const double weight = 1.0 / static_cast<double>(tolerance * tolerance);
      total += weight;
      sum += weight * p;
      moments.noalias() += weight * p * p.transpose();
    }
    if (total <= 0) return;
    const Eigen::Vector3d mean = sum / total;
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
    solver.computeDirect(moments / total - mean * mean.transpose());
    Eigen::Vector3d normal = solver.eigenvectors().col(0);
    if (normal.dot(floor.head<3>().cast<double>()) < 0) normal = -normal;
    floor << normal.cast<float>(), static_cast<float>(-normal.dot(mean));
  }
}

// A plane with much below it is a table: look again among what lies below.
std::optional<Eigen::Vector4f> FloorFinder::Impl::findLowest(const CoarseCloud& cloud, const std::vector<float>& shell,
                                                             double distance_m) {
  const Eigen::Vector3f assumed_up(0, -1, 0);
  std::optional<Eigen::Vector4f> floor;
  for (int attempt = 0; attempt < kMaxFloorTries; ++attempt) {
    collect(cloud, [&](std::size_t i) {
      const bool below =
          !floor || distanceTo(*floor, cloud.points[i]) < -3 * floorTolerance(distance_m, *floor, cloud.points[i].z());
      return below && shell[i] >= kMinShell && normals[i].dot(assumed_up) > kFloorNormal;
    });
    if (static_cast<double>(candidates.size()) < kMinFloorShare * cloud.valid_count) break;
    Eigen::Vector4f plane;
    if (!fit(cloud, assumed_up, plane)) break;
    const bool is_below_camera = plane.head<3>().dot(assumed_up) > 0 && plane[3] > kMinCameraHeight_m;
    if (!is_below_camera || floorShare(cloud, plane, distance_m) < kMinFloorShare) break;
    settle(cloud, distance_m, plane);
    floor = plane;
  }
  return floor;
}

// What is in view of the floor [m^2].
float FloorFinder::Impl::areaOf(const CoarseCloud& cloud, const Eigen::Vector4f& floor, double distance_m) const {
  float area = 0;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const Eigen::Vector3f& p = cloud.points[i];
    const Eigen::Vector3f normal = floor.head<3>();
    if (p.z() <= 0 || normals[i].dot(normal) < kAlongPlane) continue;
    if (std::abs(distanceTo(floor, p)) > floorTolerance(distance_m, floor, p.z())) continue;
    area += cloud.areaAcross(p, normal);
  }
  return area;
}

double FloorFinder::Impl::shareBelow(const CoarseCloud& cloud, const Eigen::Vector4f& floor, double distance_m) const {
  int below = 0;
  for (const Eigen::Vector3f& p : cloud.points) {
    if (p.z() > 0 && distanceTo(floor, p) < -3 * floorTolerance(distance_m, floor, p.z())) ++below;
  }
  return cloud.valid_count > 0 ? static_cast<double>(below) / cloud.valid_count : 0.0;
}

std::optional<Floor> FloorFinder::find(const CoarseCloud& cloud, const std::vector<float>& shell, double distance_m) {
  computeNormals(cloud, impl_->normals);
  const std::optional<Eigen::Vector4f> plane = impl_->findLowest(cloud, shell, distance_m);
  if (!plane || impl_->shareBelow(cloud, *plane, distance_m) > kMaxBelowShare) return std::nullopt;
  const Floor floor{*plane, impl_->areaOf(cloud, *plane, distance_m)};
  return floor.area_m2 >= kMinFloorArea_m2 ? std::optional(floor) : std::nullopt;
}

void keepOffFloor(const CoarseCloud& cloud, const std::optional<Floor>& floor, double distance_m,
                  std::vector<std::uint8_t>& keep) {
  keep.resize(cloud.points.size());
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const Eigen::Vector3f& p = cloud.points[i];
    const bool measured = p.z() > 0;
    keep[i] = measured && (!floor || distanceTo(floor->plane, p) > floorTolerance(distance_m, floor->plane, p.z()));
  }
}

double floorShare(const CoarseCloud& cloud, const Eigen::Vector4f& floor, double distance_m) {
  if (cloud.valid_count == 0) return 0;
  int on_floor = 0;
  for (const Eigen::Vector3f& p : cloud.points) {
    if (p.z() > 0 && std::abs(distanceTo(floor, p)) <= floorTolerance(distance_m, floor, p.z())) ++on_floor;
  }
  return static_cast<double>(on_floor) / cloud.valid_count;
}

}  // namespace depthmocap
