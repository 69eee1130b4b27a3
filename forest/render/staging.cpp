#include "forest/render/staging.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "depthmocap/error.h"
#include "libtracker/body/pose_surface.h"
#include "libtracker/skeleton/forward_kinematics.h"

namespace depthmocap {
namespace {

constexpr double kHalfBody_m = 0.45;  // what the view leaves free beside the root

double legLength(const BoneLengths& lengths) {
  return lengths.upper_leg + lengths.lower_leg;
}

// How far the sole lies below the ankle and the toe joint of a body standing in the zero pose [m].
struct SoleDepth {
  double below_ankle = 0;
  double below_toe = 0;

  [[nodiscard]] SoleDepth scaled(double factor) const { return {below_ankle * factor, below_toe * factor}; }
};

SoleDepth soleDepthOf(const BodySurface& body) {
  float lowest = body.vertices.front().y();
  for (const Eigen::Vector3f& v : body.vertices) lowest = std::min(lowest, v.y());
  const JointPositions joints = jointPositions(body.skeleton, Pose::Zero());
  const auto height = [&](Joint joint) { return joints(1, static_cast<int>(joint)) - static_cast<double>(lowest); };
  return {std::max(0.0, height(Joint::LeftAnkle)), std::max(0.0, height(Joint::LeftToe))};
}

// Height [m] of the lowest point of both soles.
double lowestSole(const Skeleton& skeleton, const Pose& q, const SoleDepth& sole) {
  const JointPositions joints = jointPositions(skeleton, q);
  const auto height = [&](Joint joint) { return joints(1, static_cast<int>(joint)); };
  const double ankle = std::min(height(Joint::LeftAnkle), height(Joint::RightAnkle)) - sole.below_ankle;
  const double toe = std::min(height(Joint::LeftToe), height(Joint::RightToe)) - sole.below_toe;
  return std::min(ankle, toe);
}

// Vertices of everything but the feet: these bend and roll where a rigid foot dips into the floor.
std::vector<std::size_t> verticesAboveFeet(const BodySurface& body) {
  constexpr double kAboveAnkle_m = 0.05;
  const JointPositions joints = jointPositions(body.skeleton, Pose::Zero());
  const auto ankle = static_cast<float>(joints(1, static_cast<int>(Joint::LeftAnkle)) + kAboveAnkle_m);
  std::vector<std::size_t> above;
  for (std::size_t v = 0; v < body.vertices.size(); ++v) {
    if (body.vertices[v].y() > ankle) above.push_back(v);
  }
  return above;
}

// How far [m] the lowest of some vertices lies below a height; 0 where none does.
double depthBelow(double floor_y, const std::vector<Eigen::Vector3f>& vertices,
                  const std::vector<std::size_t>& chosen) {
  auto lowest = static_cast<float>(floor_y);
  for (const std::size_t v : chosen) lowest = std::min(lowest, vertices[v].y());
  return floor_y - static_cast<double>(lowest);
}

// The floor under the performer: a low quantile of where the soles have been, so that single bad frames do not count.
double floorUnder(std::vector<double> soles) {
  constexpr double kQuantile = 0.05;
  const auto nth = soles.begin() + static_cast<std::ptrdiff_t>(kQuantile * static_cast<double>(soles.size() - 1));
  std::nth_element(soles.begin(), nth, soles.end());
  return *nth;
}

void check(const MotionClip& clip, const BodySurface& body, const StagingConfig& config) {
  const std::string where = "motion " + clip.name;
  if (clip.poses.empty()) throw Error("has no frames", where);
  if (body.vertices.empty()) throw Error("the body has no surface", where);
  if (!(config.distance_m > 0)) throw Error("the distance must be positive", where);
  if (!(config.half_view > 0)) throw Error("the field of view must be positive", where);
  if (!(config.camera_height_m > 0)) throw Error("the camera's height must be positive", where);
}

// Moves the path so that the middle of its extent is on the optical axis, at distance 0.
void centrePath(std::vector<Pose>& poses) {
  Eigen::Array2d low(poses.front()[kRootTx], poses.front()[kRootTz]);
  Eigen::Array2d high = low;
  for (const Pose& q : poses) {
    const Eigen::Array2d p(q[kRootTx], q[kRootTz]);
    low = low.min(p);
    high = high.max(p);
  }
  const Eigen::Array2d middle = 0.5 * (low + high);
  for (Pose& q : poses) {
    q[kRootTx] -= middle.x();
    q[kRootTz] -= middle.y();
  }
}

// How far away the middle of a centred path is to be so that all of it, shortened to a share, lies in view and in
// range; nothing if there is no such distance.
std::optional<double> distanceFor(const std::vector<Pose>& poses, double share, const StagingConfig& config) {
  const double min_distance = std::min(config.min_distance_m, config.distance_m);
  const double max_distance = std::max(config.max_distance_m, config.distance_m);
  const double half_body = std::min(kHalfBody_m, config.half_view * config.distance_m);
  double distance = config.distance_m;
  double back = 0;  // of the path behind its middle
  for (const Pose& q : poses) {
    const double beside = (share * std::abs(q[kRootTx]) + half_body) / config.half_view;
    distance = std::max(distance, std::max(beside, min_distance) + share * q[kRootTz]);
    back = std::max(back, -share * q[kRootTz]);
  }
  if (distance > config.distance_m && distance + back > max_distance) return std::nullopt;
  return distance;
}

// Shortens the path as far as needed and moves it in front of the camera; the share that is left of its length.
double placePath(std::vector<Pose>& poses, const StagingConfig& config) {
  constexpr int kSteps = 20;
  double share = 1.0;
  double distance = config.distance_m;
  for (int i = kSteps; i >= 0; --i) {
    share = static_cast<double>(i) / kSteps;
    const std::optional<double> found = distanceFor(poses, share, config);
    if (!found) continue;
    distance = *found;
    break;
  }
  for (Pose& q : poses) {
    q[kRootTx] *= share;
    q[kRootTz] = share * q[kRootTz] - distance;
  }
  return share;
}

}  // namespace

StagedMotion stageMotion(const MotionClip& clip, const BodySurface& body, const StagingConfig& config) {
  check(clip, body, config);
  const double ratio = legLength(body.skeleton.lengths) / legLength(clip.lengths);
  const SoleDepth sole = soleDepthOf(body);
  const Skeleton performer = makeSkeleton(clip.lengths);
  std::vector<double> performer_soles;
  for (const Pose& q : clip.poses) performer_soles.push_back(lowestSole(performer, q, sole.scaled(1.0 / ratio)));
  const double performer_floor = floorUnder(performer_soles);

  const std::vector<std::size_t> above_feet = verticesAboveFeet(body);
  std::vector<Eigen::Vector3f> vertices;
  StagedMotion staged;
  staged.floor_y = -config.camera_height_m;
  const double turn = config.yaw - clip.poses.front()[kRootRy];
  const Eigen::Matrix3d R_turn = Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitY()).toRotationMatrix();
  for (std::size_t i = 0; i < clip.poses.size(); ++i) {
    Pose q = clip.poses[i];
    q.head<3>() = R_turn * (ratio * q.head<3>());
    q[kRootRy] += turn;
    const double above_floor = ratio * (performer_soles[i] - performer_floor);
    q[kRootTy] += staged.floor_y + above_floor - lowestSole(body.skeleton, q, sole);
    poseSurface(body, q, vertices);
    q[kRootTy] += depthBelow(staged.floor_y, vertices, above_feet);
    staged.poses.push_back(q);
  }
  centrePath(staged.poses);
  staged.path_scale = placePath(staged.poses, config);
  return staged;
}

}  // namespace depthmocap
