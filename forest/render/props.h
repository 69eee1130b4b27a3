#pragma once
#include <Eigen/Geometry>

#include "depthmocap/pose.h"
#include "forest/render/depth_renderer.h"
#include "libtracker/core/random.h"
#include "libtracker/skeleton/skeleton.h"

namespace depthmocap {

// The part of what the actor carries, while a picture is made: no part of his, but within his silhouette.
inline constexpr std::uint8_t kCarried = kPartCount + 1;

// Adds what the actor carries, at random: a rucksack, a bag at the hip or in a hand, a ball, a box or a stick.
// Triangles have part kCarried. q in the world of the picture.
void addCarried(const Skeleton& skeleton, const Pose& q, Random& random, TriangleMesh& mesh);

// Adds what stands between actor and camera, at random: a counter, a table top, a post or a board. Triangles have
// Part::None.
//   actor: bounds [m] of the actor in the world of the picture, in which the camera stands above the origin and looks
//   along -z. Nothing is added where less than 10 cm are left.
void addObstacle(const Eigen::AlignedBox3d& actor, Random& random, TriangleMesh& mesh);

}  // namespace depthmocap
