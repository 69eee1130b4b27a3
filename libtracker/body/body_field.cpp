#include "libtracker/body/body_field.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "libtracker/core/check.h"

namespace depthmocap {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr int kTableSize = 48;

Eigen::Array4d extents(const Section& s) {
  return {s.outer, s.inner, s.front, s.back};
}

// Cubic Hermite with finite-difference slopes through the sections.
Eigen::Array4d interpolated(const std::vector<Section>& s, double t) {
  std::size_t i = 0;
  while (i + 2 < s.size() && t > s[i + 1].t) ++i;
  const std::size_t before = i == 0 ? 0 : i - 1;
  const std::size_t after = std::min(i + 2, s.size() - 1);
  const double width = s[i + 1].t - s[i].t;
  const double u = std::clamp((t - s[i].t) / width, 0.0, 1.0);
  const Eigen::Array4d m0 = (extents(s[i + 1]) - extents(s[before])) / (s[i + 1].t - s[before].t) * width;
  const Eigen::Array4d m1 = (extents(s[after]) - extents(s[i])) / (s[after].t - s[i].t) * width;
  const double u2 = u * u;
  const double u3 = u2 * u;
  return (2 * u3 - 3 * u2 + 1) * extents(s[i]) + (u3 - 2 * u2 + u) * m0 + (3 * u2 - 2 * u3) * extents(s[i + 1]) +
         (u3 - u2) * m1;
}

// Polynomial smooth minimum: changes nothing where a and b differ by more than k.
float smoothMin(float a, float b, float k) {
  if (k <= 0) return std::min(a, b);
  const float h = std::max(k - std::abs(a - b), 0.0F) / k;
  return std::min(a, b) - 0.25F * h * h * k;
}

float boxDistance(const Vector3f& lower, const Vector3f& upper, const Vector3f& p) {
  return (lower - p).cwiseMax(p - upper).cwiseMax(0.0F).norm();
}

// First-order distance to an ellipsoid (Quilez): |p/r| (|p/r| - 1) / |p/r^2|.
float ellipsoidDistance(const Vector3f& p, const Vector3f& r) {
  const Vector3f scaled = p.cwiseQuotient(r);
  const float k0 = scaled.norm();
  const float k1 = scaled.cwiseQuotient(r).norm();
  return k1 < 1e-6F ? -r.minCoeff() : k0 * (k0 - 1.0F) / k1;
}

// Round cone without its exact tangent correction: the ball radius is interpolated along the axis.
float coneDistance(const Vector3f& a, float ra, const Vector3f& b, float rb, const Vector3f& p) {
  const Vector3f axis = b - a;
  const float t = std::clamp((p - a).dot(axis) / axis.squaredNorm(), 0.0F, 1.0F);
  return (p - a - t * axis).norm() - (ra + t * (rb - ra));
}

}  // namespace

void BodyField::add(Mass mass) {
  lower_ = lower_.cwiseMin(mass.lower);
  upper_ = upper_.cwiseMax(mass.upper);
  masses_.push_back(std::move(mass));
}

void BodyField::addLoft(const Vector3d& origin, const Vector3d& axis, const Vector3d& lateral, const Vector3d& front,
                        const std::vector<Section>& sections, double start_cap, double end_cap, double exponent,
                        double blend) {
  DMC_CHECK(sections.size() >= 2);
  Mass mass;
  mass.kind = Mass::Kind::Loft;
  mass.a = origin.cast<float>();
  mass.frame.row(0) = lateral.cast<float>();
  mass.frame.row(1) = front.cast<float>();
  mass.frame.row(2) = axis.cast<float>();
  const double t0 = sections.front().t;
  const double t1 = sections.back().t;
  const double step = (t1 - t0) / (kTableSize - 1);
  Eigen::Array4d widest = Eigen::Array4d::Zero();
  for (int i = 0; i < kTableSize; ++i) {
    const Eigen::Array4d e = interpolated(sections, t0 + i * step);
    widest = widest.max(e);
    mass.table.push_back(e.cast<float>());
  }
  mass.t0 = static_cast<float>(t0);
  mass.step = static_cast<float>(step);
  mass.start_cap = static_cast<float>(start_cap);
  mass.end_cap = static_cast<float>(end_cap);
  mass.exponent = static_cast<float>(exponent);
  mass.blend = static_cast<float>(blend);
  for (const double l : {widest[0], -widest[1]}) {
    for (const double f : {widest[2], -widest[3]}) {
      for (const double t : {t0 - start_cap, t1 + end_cap}) {
        const Vector3f corner = (origin + l * lateral + f * front + t * axis).cast<float>();
        mass.lower = mass.lower.cwiseMin(corner);
        mass.upper = mass.upper.cwiseMax(corner);
      }
    }
  }
  add(std::move(mass));
}

void BodyField::addEllipsoid(const Vector3d& center, const Vector3d& half_axes, double blend) {
  Mass mass;
  mass.kind = Mass::Kind::Ellipsoid;
  mass.a = center.cast<float>();
  mass.b = half_axes.cast<float>();
  mass.blend = static_cast<float>(blend);
  mass.lower = mass.a - mass.b;
  mass.upper = mass.a + mass.b;
  add(std::move(mass));
}

void BodyField::addCone(const Vector3d& a, double radius_a, const Vector3d& b, double radius_b, double blend) {
  Mass mass;
  mass.kind = Mass::Kind::Cone;
  mass.a = a.cast<float>();
  mass.b = b.cast<float>();
  mass.radius_a = static_cast<float>(radius_a);
  mass.radius_b = static_cast<float>(radius_b);
  mass.blend = static_cast<float>(blend);
  const Vector3f ra = Vector3f::Constant(mass.radius_a);
  const Vector3f rb = Vector3f::Constant(mass.radius_b);
  mass.lower = (mass.a - ra).cwiseMin(mass.b - rb);
  mass.upper = (mass.a + ra).cwiseMax(mass.b + rb);
  add(std::move(mass));
}

float BodyField::loftDistance(const Mass& mass, const Vector3f& p) {
  const Vector3f local = mass.frame * (p - mass.a);
  const float position = (local.z() - mass.t0) / mass.step;
  const float last = static_cast<float>(kTableSize - 1);
  const float clamped = std::clamp(position, 0.0F, last);
  const auto i = std::min(static_cast<std::size_t>(clamped), std::size_t{kTableSize - 2});
  const float u = clamped - static_cast<float>(i);
  const Eigen::Array4f e = (1.0F - u) * mass.table[i] + u * mass.table[i + 1];
  const float beyond = (position - clamped) * mass.step;
  const float cap = beyond < 0 ? mass.start_cap : mass.end_cap;
  const Vector3f r(local.x() > 0 ? e[0] : e[1], local.y() > 0 ? e[2] : e[3], std::max(cap, 1e-4F));
  const Vector3f q(local.x(), local.y(), beyond);
  if (mass.exponent <= 2.0F) return ellipsoidDistance(q, r);
  // Superellipse: scale the point to the norm of the ellipse that has the same value.
  const Vector3f s = q.cwiseQuotient(r).cwiseAbs();
  const float norm2 = s.norm();
  if (norm2 < 1e-6F) return -r.head<2>().minCoeff();
  const float norm_p = std::pow(std::pow(s.x(), mass.exponent) + std::pow(s.y(), mass.exponent), 1.0F / mass.exponent);
  const float value = std::sqrt(norm_p * norm_p + s.z() * s.z());
  return ellipsoidDistance(q * (value / norm2), r);
}

float BodyField::massDistance(const Mass& mass, const Vector3f& p) {
  switch (mass.kind) {
    case Mass::Kind::Loft:
      return loftDistance(mass, p);
    case Mass::Kind::Ellipsoid:
      return ellipsoidDistance(p - mass.a, mass.b);
    case Mass::Kind::Cone:
      return coneDistance(mass.a, mass.radius_a, mass.b, mass.radius_b, p);
  }
  return 0;
}

float BodyField::distance(const Vector3f& point) const {
  const Vector3f p(std::abs(point.x()), point.y(), point.z());
  float d = 1e9F;
  for (const Mass& mass : masses_) {
    const float bound = boxDistance(mass.lower, mass.upper, p);
    // Past the fillet a mass changes nothing; when nothing is near, the distance to the box is good enough.
    if (bound >= d + mass.blend) continue;
    d = bound > 0.05F ? std::min(d, bound) : smoothMin(d, massDistance(mass, p), mass.blend);
  }
  d = std::max(d, static_cast<float>(floor_y_) - p.y());
  const float into_gap = std::min(static_cast<float>(half_gap_) - p.x(), static_cast<float>(crotch_y_) - p.y());
  return std::max(d, into_gap);
}

double fieldVolume(const BodyField& field, double cell) {
  const Eigen::Vector3f& lower = field.lower();
  const Eigen::Vector3f size = field.upper() - lower;
  const auto h = static_cast<float>(cell);
  const auto ny = static_cast<int>(size.y() / h) + 2;
  const auto nz = static_cast<int>(size.z() / h) + 2;
  const auto nx = static_cast<int>(field.upper().x() / h) + 2;
  double filled = 0;
  for (int k = 0; k < nz; ++k) {
    for (int j = 0; j < ny; ++j) {
      for (int i = 0; i < nx; ++i) {
        const auto x = (static_cast<float>(i) + 0.5F) * h;
        const Vector3f p(x, lower.y() + static_cast<float>(j) * h, lower.z() + static_cast<float>(k) * h);
        filled += std::clamp(0.5 - static_cast<double>(field.distance(p) / h), 0.0, 1.0);
      }
    }
  }
  return 2.0 * filled * cell * cell * cell;
}

}  // namespace depthmocap
