#include "forest/render/room_occupancy.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "forest/render/shapes.h"
#include "libtracker/core/check.h"
#include "libtracker/skeleton/forward_kinematics.h"

namespace depthmocap {
namespace {

constexpr std::size_t kMostPoses = 60;
// Limbs by their ends; their middles count as well as the joints.
constexpr std::array<std::array<Joint, 2>, 10> kLimbs = {{{Joint::Pelvis, Joint::Neck},
                                                          {Joint::LeftShoulder, Joint::LeftElbow},
                                                          {Joint::LeftElbow, Joint::LeftWrist},
                                                          {Joint::RightShoulder, Joint::RightElbow},
                                                          {Joint::RightElbow, Joint::RightWrist},
                                                          {Joint::LeftHip, Joint::LeftKnee},
                                                          {Joint::LeftKnee, Joint::LeftAnkle},
                                                          {Joint::RightHip, Joint::RightKnee},
                                                          {Joint::RightKnee, Joint::RightAnkle},
                                                          {Joint::Neck, Joint::Head}}};

std::size_t strideFor(std::size_t count) {
  return std::max<std::size_t>(1, count / kMostPoses);
}

}  // namespace

std::vector<Eigen::Vector3d> bodyPoints(const Skeleton& skeleton, std::span<const Pose> poses) {
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i < poses.size(); i += strideFor(poses.size())) {
    const JointPositions joints = jointPositions(skeleton, poses[i]);
    for (int j = 0; j < kJointCount; ++j) points.emplace_back(joints.col(j));
    for (const auto& [a, b] : kLimbs) {
      points.emplace_back(0.5 * (joints.col(static_cast<int>(a)) + joints.col(static_cast<int>(b))));
    }
  }
  return points;
}

bool isSeated(const Skeleton& skeleton, const Pose& q) {
  const JointPositions joints = jointPositions(skeleton, q);
  const auto y = [&](Joint j) { return joints(1, static_cast<int>(j)); };
  const double pelvis = y(Joint::Pelvis);
  const double foot = std::min(y(Joint::LeftAnkle), y(Joint::RightAnkle));
  return y(Joint::LeftHip) - y(Joint::LeftKnee) < 0.22 && y(Joint::RightHip) - y(Joint::RightKnee) < 0.22 &&
         y(Joint::Neck) > pelvis + 0.3 && pelvis > foot + 0.2;
}

Eigen::Vector2d Stance::forward() const {
  return {std::sin(heading), std::cos(heading)};
}

Stance stanceOf(const Skeleton& skeleton, std::span<const Pose> poses) {
  DMC_CHECK(!poses.empty());
  constexpr double kSeatedShare = 0.2;
  std::vector<const Pose*> all;
  std::vector<const Pose*> seated;
  for (std::size_t i = 0; i < poses.size(); i += strideFor(poses.size())) {
    all.push_back(&poses[i]);
    if (isSeated(skeleton, poses[i])) seated.push_back(&poses[i]);
  }
  Stance stance;
  stance.sits = static_cast<double>(seated.size()) >= kSeatedShare * static_cast<double>(all.size());
  const std::vector<const Pose*>& chosen = stance.sits ? seated : all;
  Eigen::Vector2d facing(0, 0);
  for (const Pose* q : chosen) {
    stance.place += Eigen::Vector2d((*q)[kRootTx], (*q)[kRootTz]);
    stance.pelvis_y += (*q)[kRootTy];
    facing += Eigen::Vector2d(std::sin((*q)[kRootRy]), std::cos((*q)[kRootRy]));
  }
  stance.place /= static_cast<double>(chosen.size());
  stance.pelvis_y /= static_cast<double>(chosen.size());
  stance.heading = std::atan2(facing.x(), facing.y());
  return stance;
}

PlacedPiece::PlacedPiece(TriangleMesh piece) : mesh(std::move(piece)) {
  for (const Eigen::Vector3f& v : mesh.vertices) box.extend(v.cast<double>());
}

void PlacedPiece::place(const Eigen::Vector2d& where, double turn, double floor_y) {
  T_world_piece = placed(aboutY(turn), {where.x(), floor_y, where.y()});
}

bool PlacedPiece::holds(const Eigen::Vector3d& p_world, double margin) const {
  const Eigen::Vector3d p = T_world_piece.inverse(Eigen::Isometry) * p_world;
  return p.x() > box.min().x() - margin && p.x() < box.max().x() + margin && p.z() > box.min().z() - margin &&
         p.z() < box.max().z() + margin && p.y() < box.max().y() + margin;
}

bool PlacedPiece::holdsAny(std::span<const Eigen::Vector3d> p_world, double margin) const {
  return std::ranges::any_of(p_world, [&](const Eigen::Vector3d& p) { return holds(p, margin); });
}

bool PlacedPiece::hides(std::span<const Eigen::Vector3d> p_world) const {
  constexpr int kSteps = 16;
  const Eigen::Isometry3d T_piece_world = T_world_piece.inverse(Eigen::Isometry);
  const Eigen::Vector3d from = T_piece_world.translation();  // the camera
  return std::ranges::any_of(p_world, [&](const Eigen::Vector3d& p) {
    const Eigen::Vector3d along = (T_piece_world * p - from) / kSteps;
    for (int i = 1; i < kSteps; ++i) {
      if (box.contains(from + i * along)) return true;
    }
    return false;
  });
}

bool PlacedPiece::overlaps(const PlacedPiece& other) const {
  constexpr int kSteps = 6;  // points across the floor of each box that must be free of the other
  const auto covers = [](const PlacedPiece& a, const PlacedPiece& b) {
    const Eigen::Isometry3d T_b_a = b.T_world_piece.inverse(Eigen::Isometry) * a.T_world_piece;
    for (int i = 0; i <= kSteps; ++i) {
      for (int k = 0; k <= kSteps; ++k) {
        const Eigen::Vector3d share(static_cast<double>(i) / kSteps, 0, static_cast<double>(k) / kSteps);
        const Eigen::Vector3d p = T_b_a * (a.box.min() + share.cwiseProduct(a.box.sizes()));
        if (p.x() > b.box.min().x() && p.x() < b.box.max().x() && p.z() > b.box.min().z() && p.z() < b.box.max().z()) {
          return true;
        }
      }
    }
    return false;
  };
  return covers(*this, other) || covers(other, *this);
}

}  // namespace depthmocap
