#include "libtracker/tracker/upright_world.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace depthmocap {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kTurned_rad = 1.0 * kDegree;  // floors of the same room, found one after the other, differ by less
constexpr double kMoved_m = 0.03;
constexpr int kMeanOf = 8;               // planes; a slow creep of the camera is followed
constexpr int kFirmly = 2;               // planes that must agree before a world is left
constexpr double kLargeEnough_m2 = 1.0;  // less may be a lap, a seat or a step

double angleBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

// `up`: unit, camera frame, not along the view.
Eigen::Matrix3d worldWith(const Eigen::Vector3d& up) {
  const Eigen::Vector3d view(0, 0, 1);
  const Eigen::Vector3d back = -(view - view.dot(up) * up).normalized();
  Eigen::Matrix3d R_world_camera;
  R_world_camera << up.cross(back).transpose(), up.transpose(), back.transpose();
  return R_world_camera;
}

}  // namespace

// Takes a newly found plane into the mean, or starts with it anew.
void UprightWorld::take(const Eigen::Vector4d& found) {
  const bool agrees = floor_ && angleBetween(floor_->head<3>(), found.head<3>()) < kTurned_rad &&
                      std::abs((*floor_)[3] - found[3]) < kMoved_m;
  agreeing_ = agrees ? std::min(agreeing_ + 1, kMeanOf) : 1;
  if (!agrees) floor_ = found;
  *floor_ += (found - *floor_) / agreeing_;
  *floor_ /= floor_->head<3>().norm();
}

std::optional<Eigen::Matrix3d> UprightWorld::observe(const Segmentation& segmentation) {
  const std::optional<Eigen::Vector4d>& found = segmentation.floor_camera;
  if (!found || segmentation.floor_area_m2 < kLargeEnough_m2) {
    floor_.reset();
    found_.reset();
    return std::nullopt;
  }
  if (found_ && *found_ == *found) return std::nullopt;  // the room was not looked at again
  found_ = found;
  take(*found);
  const bool firm = !from_floor_ || agreeing_ >= kFirmly;
  from_floor_ = true;
  const Eigen::Vector3d up = floor_->head<3>();
  if (!firm || angleBetween(R_world_camera_.row(1).transpose(), up) < kTurned_rad) return std::nullopt;
  const Eigen::Matrix3d R_camera_before = R_world_camera_.transpose();
  R_world_camera_ = worldWith(up);
  return R_world_camera_ * R_camera_before;
}

std::optional<Eigen::Vector4d> UprightWorld::floor() const {
  if (!floor_) return std::nullopt;
  Eigen::Vector4d floor_world = *floor_;
  floor_world.head<3>() = R_world_camera_ * floor_->head<3>();
  return floor_world;
}

}  // namespace depthmocap
