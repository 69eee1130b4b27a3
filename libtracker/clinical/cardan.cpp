#include "libtracker/clinical/cardan.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace depthmocap {
namespace {

// Cosine of the second angle below which the first and the third turn about one axis.
constexpr double kLocked = 1e-6;

double distance(const CardanAngles& a, const CardanAngles& b) {
  return std::abs(a.flexion - b.flexion) + std::abs(a.adduction - b.adduction) + std::abs(a.rotation - b.rotation);
}

CardanAngles near(CardanAngles angles, const CardanAngles& before) {
  angles.flexion = unwrapped(angles.flexion, before.flexion);
  angles.adduction = unwrapped(angles.adduction, before.adduction);
  angles.rotation = unwrapped(angles.rotation, before.rotation);
  return angles;
}

}  // namespace

double unwrapped(double angle, double near) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  return angle - kTurn * std::round((angle - near) / kTurn);
}

// R = Rx(-flexion) Rz(adduction) Ry(rotation): our x points left.
CardanAngles cardanAngles(const Eigen::Matrix3d& R, const CardanAngles& before) {
  CardanAngles first{before.flexion, std::asin(std::clamp(-R(0, 1), -1.0, 1.0)), 0};
  if (std::hypot(R(1, 1), R(2, 1)) < kLocked) {
    // Without the first turn, and with a right angle for the second, row 2 is (-sin, 0, cos) of the third.
    const double c = std::cos(before.flexion);
    const double s = std::sin(before.flexion);
    const Eigen::RowVector3d row = c * R.row(2) + s * R.row(1);
    first.rotation = std::atan2(-row.x(), row.z());
    return near(first, before);
  }
  first.flexion = -std::atan2(R(2, 1), R(1, 1));
  first.rotation = std::atan2(R(0, 2), R(0, 0));
  constexpr double kHalfTurn = std::numbers::pi;
  const CardanAngles second{first.flexion + kHalfTurn, kHalfTurn - first.adduction, first.rotation + kHalfTurn};
  const CardanAngles a = near(first, before);
  const CardanAngles b = near(second, before);
  return distance(a, before) <= distance(b, before) ? a : b;
}

}  // namespace depthmocap
