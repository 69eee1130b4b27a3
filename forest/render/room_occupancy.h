#pragma once
#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "depthmocap/pose.h"
#include "forest/render/depth_renderer.h"
#include "libtracker/skeleton/skeleton.h"

namespace depthmocap {

// Joints and the middles of limbs [m] of up to 60 poses, evenly chosen.
std::vector<Eigen::Vector3d> bodyPoints(const Skeleton& skeleton, std::span<const Pose> poses);

// Where an actor mostly is and faces: while seated, if a fifth of the poses is.
struct Stance {
  Eigen::Vector2d place = Eigen::Vector2d::Zero();  // (x, z) [m] of the pelvis
  double heading = 0;                               // [rad] 0 faces +z
  double pelvis_y = 0;                              // [m]
  bool sits = false;

  [[nodiscard]] Eigen::Vector2d forward() const;  // (x, z)
};
// Of at least one pose.
Stance stanceOf(const Skeleton& skeleton, std::span<const Pose> poses);
// Whether a pose is one of somebody who sits on something: thighs level, trunk upright, pelvis above the feet.
bool isSeated(const Skeleton& skeleton, const Pose& q);

// A piece of furniture in its place: its box in its own frame.
struct PlacedPiece {
  TriangleMesh mesh;        // in the frame of the piece
  Eigen::AlignedBox3d box;  // [m] likewise
  Eigen::Isometry3d T_world_piece = Eigen::Isometry3d::Identity();

  explicit PlacedPiece(TriangleMesh piece);
  // (x, z) [m] and turn [rad] about the vertical.
  void place(const Eigen::Vector2d& where, double turn, double floor_y);
  // Whether a point of the world lies in the box grown by `margin` [m] to the sides and upwards.
  [[nodiscard]] bool holds(const Eigen::Vector3d& p_world, double margin) const;
  // Whether the box hides any of the points from the camera at the origin.
  [[nodiscard]] bool hides(std::span<const Eigen::Vector3d> p_world) const;
  [[nodiscard]] bool holdsAny(std::span<const Eigen::Vector3d> p_world, double margin) const;
  [[nodiscard]] bool overlaps(const PlacedPiece& other) const;
};

}  // namespace depthmocap
