#pragma once
#include <algorithm>
#include <cmath>
#include <numbers>

namespace depthmocap {

// Shapes of movement over time, u in [0, 1] (clamped): 0 -> 0, 1 -> 1.
inline double smoothStep(double u) {
  const double c = std::clamp(u, 0.0, 1.0);
  return c * c * (3.0 - 2.0 * c);
}
// Minimum jerk: how people move a hand or a foot from rest to rest (Flash and Hogan 1985).
inline double minimumJerk(double u) {
  const double c = std::clamp(u, 0.0, 1.0);
  return c * c * c * (10.0 + c * (6.0 * c - 15.0));
}
// 0 -> 0, 0.5 -> 1, 1 -> 0.
inline double bump(double u) {
  const double s = std::sin(std::numbers::pi * std::clamp(u, 0.0, 1.0));
  return s * s;
}
inline double lerp(double a, double b, double u) {
  return a + (b - a) * u;
}
inline double wave(double cycles) {
  return std::cos(2.0 * std::numbers::pi * cycles);
}

constexpr double degrees(double value) {
  return value * std::numbers::pi / 180.0;
}

}  // namespace depthmocap
