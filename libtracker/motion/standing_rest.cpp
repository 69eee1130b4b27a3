#include "libtracker/motion/standing_rest.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace depthmocap {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

double angle(const Vector3d& a, const Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

// The lines of a body in one pose, in the world.
class Stance {
 public:
  Stance(const GlobalFrame& frame, const NamedBones& named) {
    const auto p = [&](int bone) -> const Vector3d& { return frame.position[at(bone)]; };
    const std::array<const NamedBones::Side*, 2> sides = {&named.left, &named.right};
    const Vector3d hips = 0.5 * (p(named.left.femur) + p(named.right.femur));
    const Vector3d shoulders = 0.5 * (p(named.left.humerus) + p(named.right.humerus));
    trunk = shoulders - hips;
    head = p(named.head) - shoulders;
    across_hips = p(named.left.femur) - p(named.right.femur);
    across_shoulders = p(named.left.humerus) - p(named.right.humerus);
    for (std::size_t s = 0; s < 2; ++s) {
      thigh[s] = p(sides[s]->tibia) - p(sides[s]->femur);
      shin[s] = sides[s]->foot < 0 ? thigh[s] : Vector3d(p(sides[s]->foot) - p(sides[s]->tibia));
      upper_arm[s] = p(sides[s]->radius) - p(sides[s]->humerus);
      lower_arm[s] = sides[s]->hand < 0 ? upper_arm[s] : Vector3d(p(sides[s]->hand) - p(sides[s]->radius));
    }
  }

  // Left, up (along `up`) and forward of the pelvis as columns.
  [[nodiscard]] Matrix3d axes(const Vector3d& up) const {
    const Vector3d forward = across_hips.cross(up).normalized();
    Matrix3d R;
    R << up.cross(forward), up, forward;
    return R;
  }

  // A person who stands, whatever the arms do as long as they are on their own sides.
  [[nodiscard]] bool stands() const {
    constexpr double kWide = 0.9;  // [rad] rest poses with feet apart and heads ahead stay far below
    const Vector3d left = across_hips.normalized();
    for (std::size_t s = 0; s < 2; ++s) {
      if (angle(thigh[s], -trunk) > kWide || angle(shin[s], -trunk) > kWide) return false;
      const Vector3d outward = s == 0 ? left : Vector3d(-left);
      constexpr double kInward = -0.5;
      if (outward.dot(upper_arm[s].normalized()) < kInward || angle(upper_arm[s], trunk) < kWide) return false;
    }
    // A head's joint may lie between the shoulders.
    constexpr double kShortNeck = 0.15;
    const bool head_up = head.norm() < kShortNeck * trunk.norm() || angle(head, trunk) < kWide;
    return head_up && angle(across_hips, across_shoulders) < kWide;
  }

  // How far the pose is from a T-pose, whichever way the body lies [rad^2].
  [[nodiscard]] double distanceFromT() const {
    constexpr double kArms = 0.2;  // weight: a pose with hanging arms serves nearly as well
    const auto squared = [](double x) { return x * x; };
    const Vector3d left = across_hips.normalized();
    double sum = squared(angle(head, trunk)) + squared(angle(across_hips, across_shoulders)) +
                 squared(std::abs(angle(across_hips, trunk) - 0.5 * std::numbers::pi));
    for (std::size_t s = 0; s < 2; ++s) {
      sum += squared(angle(thigh[s], -trunk)) + squared(angle(shin[s], -trunk));
      sum += kArms * squared(angle(upper_arm[s], s == 0 ? left : Vector3d(-left)));
      sum += kArms * squared(angle(lower_arm[s], upper_arm[s]));
    }
    return sum;
  }

  Vector3d trunk, head, across_hips, across_shoulders;
  std::array<Vector3d, 2> thigh, shin, upper_arm, lower_arm;  // left, right
};

// The axis nearest to a direction.
Vector3d nearestAxis(const Vector3d& v) {
  Eigen::Index axis = 0;
  v.cwiseAbs().maxCoeff(&axis);
  return v[axis] < 0 ? Vector3d(-Vector3d::Unit(axis)) : Vector3d(Vector3d::Unit(axis));
}

// Frames that are looked at, spread over the motion.
std::vector<std::size_t> someFrames(const SourceMotion& motion) {
  constexpr std::size_t kMost = 1000;
  const std::size_t step = 1 + motion.frames.size() / kMost;
  std::vector<std::size_t> frames;
  for (std::size_t f = 0; f < motion.frames.size(); f += step) frames.push_back(f);
  return frames;
}

Vector3d meanTrunk(const SourceMotion& motion, const NamedBones& named) {
  Vector3d sum = Vector3d::Zero();
  GlobalFrame global;
  const std::vector<std::size_t> frames = someFrames(motion);
  for (const std::size_t f : frames) {
    globalFrame(motion.bones, motion.frames[f], global);
    sum += Stance(global, named).trunk.normalized();
  }
  return sum / static_cast<double>(frames.size());
}

// In nearly all frames the lowest joint along `up` is at the height zero: a floor.
bool standsOnFloor(const SourceMotion& motion, const NamedBones& named, const Vector3d& up) {
  constexpr double kNear = 0.15;  // of the trunk's length
  constexpr double kNearlyAll = 0.8;
  GlobalFrame global;
  const std::vector<std::size_t> frames = someFrames(motion);
  std::size_t on_floor = 0;
  for (const std::size_t f : frames) {
    globalFrame(motion.bones, motion.frames[f], global);
    double lowest = std::numeric_limits<double>::max();
    for (const Vector3d& p : global.position) lowest = std::min(lowest, up.dot(p));
    if (std::abs(lowest) < kNear * Stance(global, named).trunk.norm()) ++on_floor;
  }
  return static_cast<double>(on_floor) > kNearlyAll * static_cast<double>(frames.size());
}

// The world's up axis. `usual` is up unless trunks hardly ever point along it and nearly always along another one.
// A person may lie all the time along one of the axes, so that the usual y is given up only for one who stands on a
// floor.
Vector3d worldUp(const SourceMotion& motion, const NamedBones& named, const Vector3d& usual) {
  constexpr double kHardly = 0.35;
  constexpr double kNearlyAlways = 0.75;
  const Vector3d trunk = meanTrunk(motion, named);
  const Vector3d other = nearestAxis(trunk);
  if (usual.dot(trunk) > kHardly || other.dot(trunk) < kNearlyAlways) return usual;
  return usual != Vector3d::UnitY() || standsOnFloor(motion, named, other) ? other : usual;
}

// Turns every bone's frame so that its orientation `R_world_bone` becomes the identity.
void rebase(SourceMotion& motion, const std::vector<Matrix3d>& R_world_bone) {
  std::vector<Eigen::Quaterniond> turn;
  turn.reserve(R_world_bone.size());
  for (const Matrix3d& R : R_world_bone) turn.emplace_back(R);
  const auto parentTurn = [&](std::size_t b) {
    return motion.bones[b].parent < 0 ? Eigen::Quaterniond::Identity() : turn[at(motion.bones[b].parent)];
  };
  for (std::size_t b = 0; b < motion.bones.size(); ++b) {
    MotionBone& bone = motion.bones[b];
    bone.offset = parentTurn(b) * bone.offset;
    bone.tip = turn[b] * bone.tip;
    for (MotionFrame& frame : motion.frames) {
      frame.position[b] = parentTurn(b) * frame.position[b];
      frame.rotation[b] = parentTurn(b) * frame.rotation[b] * turn[b].conjugate();
    }
  }
}

// The bones' orientations in the frame that is most like a T-pose, turned so that the person stands along `up`.
std::vector<Matrix3d> bestFrame(const SourceMotion& motion, const NamedBones& named, const Vector3d& up) {
  double best = std::numeric_limits<double>::max();
  GlobalFrame global;
  GlobalFrame chosen;
  for (const std::size_t f : someFrames(motion)) {
    globalFrame(motion.bones, motion.frames[f], global);
    const double distance = Stance(global, named).distanceFromT();
    if (distance >= best) continue;
    best = distance;
    chosen = global;
  }
  const Stance stance(chosen, named);
  // A trunk that leans a little belongs to the pose; one that leans far is a body that does not stand.
  constexpr double kLittle = 0.25;  // [rad]
  const Vector3d line = angle(stance.trunk, up) < kLittle ? up : Vector3d(stance.trunk.normalized());
  const Vector3d across = stance.across_hips - up * up.dot(stance.across_hips);
  Matrix3d standing;
  standing << (line == up ? Vector3d(across.normalized()) : Vector3d(up.unitOrthogonal())), up, Vector3d::Zero();
  standing.col(2) = standing.col(0).cross(up);
  for (Matrix3d& R : chosen.rotation) R = standing * stance.axes(line).transpose() * R;
  return chosen.rotation;
}

}  // namespace

SourceMotion withStandingRest(SourceMotion motion, const NamedBones& named) {
  const GlobalFrame rest = restFrame(meanBones(motion));
  const Stance stance(rest, named);
  if (!stance.stands()) {
    const Vector3d up = worldUp(motion, named, Vector3d::UnitY());
    rebase(motion, bestFrame(motion, named, up));
    motion.warnings.push_back("zero rotations are no standing pose: the frame most like a T-pose is taken for one");
    return motion;
  }
  const Vector3d rest_up = nearestAxis(stance.trunk);
  const Vector3d up = worldUp(motion, named, rest_up);
  if (up != rest_up) {
    const Matrix3d turn = Eigen::Quaterniond::FromTwoVectors(rest_up, up).toRotationMatrix();
    rebase(motion, std::vector<Matrix3d>(motion.bones.size(), turn));
    motion.warnings.push_back("people stand along another axis than the rest pose: that one is taken for up");
  }
  return motion;
}

}  // namespace depthmocap
