#include "libtracker/skeleton/facing_of.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace depthmocap {
namespace {

// Of a facing that the pose speaks against, over that of one it speaks for: nobody turns round between two frames.
constexpr float kSurpriseShare = 0.002F;

double bearingOf(Facing facing) {
  return static_cast<double>(facing) * std::numbers::pi / 2.0;
}

}  // namespace

// A heading of 0 faces +z with the left along +x.
double cameraBearing(const Pose& q_world) {
  const double heading = q_world[kRootRy];
  const Eigen::Vector2d to_camera(-q_world[kRootTx], -q_world[kRootTz]);
  const double front = to_camera.dot(Eigen::Vector2d(std::sin(heading), std::cos(heading)));
  const double left = to_camera.dot(Eigen::Vector2d(std::cos(heading), -std::sin(heading)));
  return std::atan2(left, front);
}

Facing facingOf(const Pose& q_world) {
  const double quarter_turns = cameraBearing(q_world) / (std::numbers::pi / 2.0);
  return static_cast<Facing>((std::lround(quarter_turns) + kFacingCount) % kFacingCount);
}

FacingShares expectedFacing(const Pose& q_world) {
  const double bearing = cameraBearing(q_world);
  FacingShares shares;
  for (int f = 0; f < kFacingCount; ++f) {
    const double agreement = std::max(0.0, std::cos(bearing - bearingOf(static_cast<Facing>(f))));
    shares[static_cast<std::size_t>(f)] = kSurpriseShare + static_cast<float>(agreement);
  }
  return shares;
}

}  // namespace depthmocap
