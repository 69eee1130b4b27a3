#include "forest/render/props.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "forest/render/shapes.h"
#include "libtracker/skeleton/forward_kinematics.h"

namespace depthmocap {
namespace {

constexpr double kBoxy = 0.1;  // roundness of what has edges

void addThing(const Eigen::Isometry3d& T_world_thing, const Eigen::Vector3d& half, double roundness, std::uint8_t part,
              TriangleMesh& mesh) {
  addSuperquadric(mesh, T_world_thing, half, roundness);
  fillParts(mesh, part);
}

Eigen::Matrix3d anyRotation(Random& random) {
  const Eigen::Quaterniond q{random.normal(), random.normal(), random.normal(), random.normal()};
  return q.normalized().toRotationMatrix();
}

// The roundness of a bag.
double softness(Random& random) {
  return random.uniform(0.3, 0.8);
}

void addRucksack(const ForwardKinematics& fk, Random& random, TriangleMesh& mesh) {
  const Eigen::Vector3d half{random.uniform(0.11, 0.19), random.uniform(0.15, 0.27), random.uniform(0.05, 0.13)};
  const Eigen::Vector3d p_back{0, random.uniform(0.05, 0.2), -random.uniform(0.07, 0.11) - half.z()};
  const Eigen::Matrix3d& R = fk.R_world_bone(Bone::UpperBack);
  addThing(placed(R, fk.origin(Bone::UpperBack) + R * p_back), half, softness(random), kCarried, mesh);
}

void addHipBag(const ForwardKinematics& fk, double hip_width_m, Random& random, TriangleMesh& mesh) {
  const Eigen::Vector3d half{random.uniform(0.03, 0.08), random.uniform(0.1, 0.18), random.uniform(0.12, 0.2)};
  const double side = random.uniform() < 0.5 ? -1.0 : 1.0;
  const Eigen::Vector3d p_hip{side * (0.5 * hip_width_m + random.uniform(0.06, 0.11) + half.x()),
                              random.uniform(-0.25, 0.05), random.uniform(-0.1, 0.15)};
  const Eigen::Matrix3d& R = fk.R_world_bone(Bone::Root);
  addThing(placed(R, fk.origin(Bone::Root) + R * p_hip), half, softness(random), kCarried, mesh);
}

// The middle of one hand, some way beyond the wrist.
Eigen::Vector3d anyHand(const Skeleton& skeleton, const Pose& q, Random& random) {
  const JointPositions joints = jointPositions(skeleton, q);
  const bool left = random.uniform() < 0.5;
  const Eigen::Vector3d wrist = joints.col(static_cast<int>(left ? Joint::LeftWrist : Joint::RightWrist));
  const Eigen::Vector3d elbow = joints.col(static_cast<int>(left ? Joint::LeftElbow : Joint::RightElbow));
  return wrist + 0.09 * (wrist - elbow).normalized();
}

void addHandbag(const Eigen::Vector3d& hand, Random& random, TriangleMesh& mesh) {
  const Eigen::Vector3d half{random.uniform(0.12, 0.22), random.uniform(0.1, 0.2), random.uniform(0.03, 0.08)};
  const Eigen::Vector3d below(0, -half.y() - random.uniform(-0.05, 0.06), 0);
  const Eigen::Matrix3d R = aboutY(random.uniform(0, std::numbers::pi));
  addThing(placed(R, hand + below), half, softness(random), kCarried, mesh);
}

// A ball, a book, a box.
void addHeld(const Eigen::Vector3d& hand, Random& random, TriangleMesh& mesh) {
  const double size = random.uniform(0.04, 0.14);
  const Eigen::Vector3d half{size, size * random.uniform(0.4, 1), size * random.uniform(0.4, 1)};
  const Eigen::Matrix3d R = anyRotation(random);
  addThing(placed(R, hand), half, random.uniform(0.2, 1), kCarried, mesh);
}

void addStick(const Eigen::Vector3d& hand, Random& random, TriangleMesh& mesh) {
  const double length = random.uniform(0.3, 1.1);
  const double half_width = random.uniform(0.012, 0.03);
  const Eigen::Matrix3d R = anyRotation(random);
  const Eigen::Vector3d middle = hand + random.uniform(0.0, 0.45) * length * R.col(0);
  addThing(placed(R, middle), {0.5 * length, half_width, half_width}, 0.5, kCarried, mesh);
}

// Where something stands that hides the actor.
struct Obstacle {
  Eigen::Vector3d half;  // [m]
  double x, y;           // [m] of its middle, x where the actor is
  double turn = 0;       // [rad] about the vertical
  double lean = 0;       // [rad] about the line of sight
};

Obstacle anyObstacle(const Eigen::AlignedBox3d& actor, Random& random) {
  const double floor = actor.min().y();
  const double height = actor.max().y() - floor;
  const double x = actor.center().x() + random.uniform(-0.35, 0.35) * actor.sizes().x();
  switch (random.below(4)) {
    case 0: {  // a counter, a sofa's back
      const double half_height = 0.5 * height * random.uniform(0.2, 0.6);
      return {{random.uniform(0.3, 1.0), half_height, 0.05}, x, floor + half_height, random.uniform(-0.3, 0.3)};
    }
    case 1:  // a table top
      return {{random.uniform(0.4, 1.0), 0.02, random.uniform(0.2, 0.45)},
              x,
              floor + height * random.uniform(0.3, 0.6),
              random.uniform(-0.3, 0.3)};
    case 2:  // a post, a door's frame
      return {{random.uniform(0.02, 0.12), 1.2 * height, 0.05}, x, floor + 0.5 * height, 0, random.uniform(-0.1, 0.1)};
    default:  // a board, a screen, a plant
      return {{random.uniform(0.08, 0.3), random.uniform(0.08, 0.3), 0.03},
              x,
              floor + height * random.uniform(),
              random.uniform(-0.5, 0.5),
              random.uniform(-0.8, 0.8)};
  }
}

}  // namespace

void addCarried(const Skeleton& skeleton, const Pose& q, Random& random, TriangleMesh& mesh) {
  ForwardKinematics fk;
  fk.update(skeleton, q);
  switch (random.below(5)) {
    case 0:
      return addRucksack(fk, random, mesh);
    case 1:
      return addHipBag(fk, skeleton.lengths.hip_width, random, mesh);
    case 2:
      return addHandbag(anyHand(skeleton, q, random), random, mesh);
    case 3:
      return addHeld(anyHand(skeleton, q, random), random, mesh);
    default:
      return addStick(anyHand(skeleton, q, random), random, mesh);
  }
}

void addObstacle(const Eigen::AlignedBox3d& actor, Random& random, TriangleMesh& mesh) {
  constexpr double kMinRoom_m = 0.1;
  const double room = std::min(0.8, -actor.max().z() - 0.5);  // [m] none within 50 cm of the camera
  if (room < kMinRoom_m) return;
  Obstacle thing = anyObstacle(actor, random);
  thing.half.z() = std::min(thing.half.z(), 0.4 * room);
  const double z = actor.max().z() + thing.half.z() + random.uniform() * (room - 2.0 * thing.half.z());
  thing.x *= z / actor.center().z();  // on the line of sight
  const Eigen::Matrix3d R =
      aboutY(thing.turn) * Eigen::AngleAxisd(thing.lean, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  addThing(placed(R, {thing.x, thing.y, z}), thing.half, kBoxy, static_cast<std::uint8_t>(Part::None), mesh);
}

}  // namespace depthmocap
