#include "libtracker/segment/planes.h"

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

#include "libtracker/segment/surface_shape.h"

namespace depthmocap {

namespace {

// Chosen by hand: no comparison of values is on record (docs/tuning.md).
// Exceptions are kMaxPoints and kMaxIterations: 3000 and 150 gave no better planes, but frames above 10 ms.

// [rad] The promise of Segmenter: the camera is upright within 30 degrees.
constexpr double kMaxTilt_rad = 30.0 * std::numbers::pi / 180.0;
// [rad] Greatest angle between a wall and the vertical, which the floor gives where it is seen.
constexpr double kMaxWallTilt_rad = 10.0 * std::numbers::pi / 180.0;
// Least cosine between a floor cell's normal and the assumed up: 40 degrees, which are kMaxTilt_rad and noise.
constexpr float kFloorNormal = 0.77F;
// Greatest sine of a wall cell's tilt: 20 degrees, which are kMaxWallTilt_rad and noise.
constexpr float kWallNormal = 0.35F;
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
// [m^2] Least area in view of a wall; cupboard doors have less.
constexpr float kMinWallArea_m2 = 1.2F;
// [m] Least width of a wall.
constexpr float kMinWallWidth_m = 1.0F;
// Upright planes tried for walls.
constexpr int kMaxWallTries = 4;
// Least cosine between a cell's normal and the plane that it belongs to: 32 degrees.
constexpr float kAlongPlane = 0.85F;
// [m] Distance of RANSAC's inliers from the plane: about two standard deviations of the noise at 3 m.
constexpr double kFitDistance_m = 0.03;
// [m] Distance from the plane up to which a point is wall, in addition to noise.
constexpr float kWallDistance_m = 0.06F;

// How far from a wall a point still belongs to it [m]; walls are met at large angles.
float wallTolerance(float depth_m) {
  return kWallDistance_m + 2.0F * kDepthNoise_per_m * depth_m * depth_m;
}

using PclCloud = pcl::PointCloud<pcl::PointXYZ>;

float distanceTo(const Eigen::Vector4f& plane, const Eigen::Vector3f& p) {
  return plane.head<3>().dot(p) + plane[3];
}

}  // namespace

struct PlaneFinder::Impl {
  std::vector<Eigen::Vector3f> normals;
  std::vector<std::size_t> candidates;
  std::vector<std::uint8_t> keep;
  PclCloud::Ptr points = std::make_shared<PclCloud>();
  pcl::PointIndices inliers;
  pcl::ModelCoefficients coefficients;

  template <typename Accept>
  void collect(const CoarseCloud& cloud, Accept&& accept);
  bool fit(const CoarseCloud& cloud, int model, double max_angle_rad, const Eigen::Vector3f& axis,
           Eigen::Vector4f& plane);
  std::optional<Eigen::Vector4f> findFloor(const CoarseCloud& cloud, double distance_m);
  void settle(const CoarseCloud& cloud, double distance_m, Eigen::Vector4f& floor) const;
  [[nodiscard]] float areaOf(const CoarseCloud& cloud, const Eigen::Vector4f& floor, double distance_m) const;
  void findWalls(const CoarseCloud& cloud, double distance_m, RoomPlanes& planes);
  bool boundWall(const CoarseCloud& cloud, const Eigen::Vector3f& up, Wall& wall) const;
};

PlaneFinder::PlaneFinder() : impl_(std::make_unique<Impl>()) {
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);  // PCL prints warnings about samples; libraries do not print
}
PlaneFinder::~PlaneFinder() = default;

template <typename Accept>
void PlaneFinder::Impl::collect(const CoarseCloud& cloud, Accept&& accept) {
  candidates.clear();
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    if (cloud.points[i].z() > 0 && normals[i].squaredNorm() > 0 && accept(i)) candidates.push_back(i);
  }
}

bool PlaneFinder::Impl::fit(const CoarseCloud& cloud, int model, double max_angle_rad, const Eigen::Vector3f& axis,
                            Eigen::Vector4f& plane) {
  const std::size_t step = (candidates.size() + kMaxPoints - 1) / kMaxPoints;
  points->clear();
  for (std::size_t k = 0; k < candidates.size(); k += step) {
    const Eigen::Vector3f& p = cloud.points[candidates[k]];
    points->push_back(pcl::PointXYZ(p.x(), p.y(), p.z()));
  }
  if (points->size() < 50) return false;
  pcl::SACSegmentation<pcl::PointXYZ> segmentation(false);  // false: PCL's fixed seed
  segmentation.setModelType(model);
  segmentation.setMethodType(pcl::SAC_RANSAC);
  segmentation.setOptimizeCoefficients(true);
  segmentation.setMaxIterations(kMaxIterations);
  segmentation.setDistanceThreshold(kFitDistance_m);
  segmentation.setAxis(axis);
  segmentation.setEpsAngle(max_angle_rad);
  segmentation.setInputCloud(points);
  segmentation.segment(inliers, coefficients);
  if (inliers.indices.size() < 50 || coefficients.values.size() != 4) return false;
  plane = Eigen::Map<const Eigen::Vector4f>(coefficients.values.data());
  plane /= plane.head<3>().norm();
  if (plane[3] < 0) plane = -plane;  // the normal points to the camera's side
  return plane.allFinite();
}

// RANSAC's plane rests on few points: least squares over all candidates near it, weighted by what noise allows.
void PlaneFinder::Impl::settle(const CoarseCloud& cloud, double distance_m, Eigen::Vector4f& floor) const {
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
std::optional<Eigen::Vector4f> PlaneFinder::Impl::findFloor(const CoarseCloud& cloud, double distance_m) {
  const Eigen::Vector3f assumed_up(0, -1, 0);
  std::optional<Eigen::Vector4f> floor;
  for (int attempt = 0; attempt < kMaxFloorTries; ++attempt) {
    collect(cloud, [&](std::size_t i) {
      const bool below =
          !floor || distanceTo(*floor, cloud.points[i]) < -3 * floorTolerance(distance_m, *floor, cloud.points[i].z());
      return below && normals[i].dot(assumed_up) > kFloorNormal;
    });
    if (static_cast<double>(candidates.size()) < kMinFloorShare * cloud.valid_count) break;
    Eigen::Vector4f plane;
    if (!fit(cloud, pcl::SACMODEL_PERPENDICULAR_PLANE, kMaxTilt_rad, assumed_up, plane)) break;
    const bool is_below_camera = plane.head<3>().dot(assumed_up) > 0 && plane[3] > kMinCameraHeight_m;
    if (!is_below_camera || floorShare(cloud, plane, distance_m) < kMinFloorShare) break;
    settle(cloud, distance_m, plane);
    floor = plane;
  }
  return floor;
}

// What is in view of the floor [m^2].
float PlaneFinder::Impl::areaOf(const CoarseCloud& cloud, const Eigen::Vector4f& floor, double distance_m) const {
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

// Ends of the wall: the 1st and 99th hundredth of its points, so that a stray inlier does not lengthen it.
bool PlaneFinder::Impl::boundWall(const CoarseCloud& cloud, const Eigen::Vector3f& up, Wall& wall) const {
  const Eigen::Vector3f normal = wall.plane.head<3>();
  wall.along = up.cross(normal).normalized();
  std::vector<float> positions;
  float area = 0;
  for (const std::size_t i : candidates) {
    const Eigen::Vector3f& p = cloud.points[i];
    if (std::abs(distanceTo(wall.plane, p)) > wallTolerance(p.z()) || normals[i].dot(normal) < kAlongPlane) continue;
    positions.push_back(wall.along.dot(p));
    area += cloud.areaAcross(p, normal);
  }
  if (area < kMinWallArea_m2) return false;
  std::sort(positions.begin(), positions.end());
  wall.low = positions[positions.size() / 100] - 0.1F;
  wall.high = positions[positions.size() - 1 - positions.size() / 100] + 0.1F;
  return wall.high - wall.low > kMinWallWidth_m;
}

// A plane too small for a wall (a cupboard's door) is set aside, so that the next try finds what lies beside it.
void PlaneFinder::Impl::findWalls(const CoarseCloud& cloud, double distance_m, RoomPlanes& planes) {
  const Eigen::Vector3f up = planes.floor ? Eigen::Vector3f(planes.floor->head<3>()) : Eigen::Vector3f(0, -1, 0);
  keepOffPlanes(cloud, planes, distance_m, keep);
  for (int attempt = 0; attempt < kMaxWallTries; ++attempt) {
    collect(cloud, [&](std::size_t i) { return keep[i] != 0 && std::abs(normals[i].dot(up)) < kWallNormal; });
    Wall wall;
    if (!fit(cloud, pcl::SACMODEL_PARALLEL_PLANE, kMaxWallTilt_rad, up, wall.plane)) return;
    if (boundWall(cloud, up, wall)) planes.walls.push_back(wall);
    for (const std::size_t i : candidates) {
      const Eigen::Vector3f& p = cloud.points[i];
      if (std::abs(distanceTo(wall.plane, p)) <= wallTolerance(p.z())) keep[i] = 0;
    }
  }
}

void PlaneFinder::find(const CoarseCloud& cloud, double distance_m, RoomPlanes& planes) {
  planes.walls.clear();
  impl_->keep.assign(cloud.points.size(), 1);
  computeNormals(cloud, impl_->keep, impl_->normals);
  planes.floor = impl_->findFloor(cloud, distance_m);
  planes.floor_area_m2 = planes.floor ? impl_->areaOf(cloud, *planes.floor, distance_m) : 0.0F;
  impl_->findWalls(cloud, distance_m, planes);
}

void keepOffPlanes(const CoarseCloud& cloud, const RoomPlanes& planes, double distance_m,
                   std::vector<std::uint8_t>& keep) {
  keep.resize(cloud.points.size());
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const Eigen::Vector3f& p = cloud.points[i];
    bool off = p.z() > 0;
    if (off && planes.floor) off = distanceTo(*planes.floor, p) > floorTolerance(distance_m, *planes.floor, p.z());
    for (const Wall& wall : planes.walls) {
      if (!off) break;
      const float t = wall.along.dot(p);
      off = std::abs(distanceTo(wall.plane, p)) > wallTolerance(p.z()) || t < wall.low || t > wall.high;
    }
    keep[i] = off ? 1 : 0;
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
