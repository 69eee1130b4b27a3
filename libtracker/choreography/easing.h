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
// Slope at a key between two straight pieces of slopes d0, d1 and lengths h0, h1 that lets a cubic spline not overshoot
// (Fritsch and Carlson 1980): rest at every turning point.
inline double shapePreservingSlope(double d0, double d1, double h0, double h1) {
  if (d0 * d1 <= 0) return 0.0;
  const double w0 = 2 * h1 + h0;
  const double w1 = h1 + 2 * h0;
  return (w0 + w1) / (w0 / d0 + w1 / d1);
}
// Cubic Hermite weights at u in [0, 1] of a piece of length h: value = a p0 + b m0 + c p1 + d m1 with slopes m.
struct HermiteWeights {
  double a, b, c, d;
};
inline HermiteWeights hermiteWeights(double u, double h) {
  const double u2 = u * u;
  const double u3 = u2 * u;
  return {2 * u3 - 3 * u2 + 1, (u3 - 2 * u2 + u) * h, 3 * u2 - 2 * u3, (u3 - u2) * h};
}
inline double wave(double cycles) {
  return std::cos(2.0 * std::numbers::pi * cycles);
}

constexpr double degrees(double value) {
  return value * std::numbers::pi / 180.0;
}

}  // namespace depthmocap
