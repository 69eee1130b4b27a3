#include "libtracker/body/clothing.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "depthmocap/error.h"
#include "libtracker/body/skin_weights.h"

namespace depthmocap {
namespace {

using Eigen::Vector3d;

// Distance over which a hem fades out, as a share of the upper arm (a centimetre or two).
constexpr double kHemShare = 0.07;
constexpr double kInnerStretch = 1.8;
constexpr double kMiddleGap = 0.002;  // [m] that each leg keeps from the middle plane

double smoothStep(double from, double to, double value) {
  const double t = std::clamp((value - from) / (to - from), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

void validate(const Clothing& c) {
  const auto require = [](const char* field, double value, double low, double high) {
    if (value >= low && value <= high) return;
    throw Error(fmt::format("{} is {}, outside {} .. {}", field, value, low, high), "clothing");
  };
  require("top_m", c.top_m, 0, 0.05);
  require("sleeve", c.sleeve, 0, 1);
  require("trousers_m", c.trousers_m, 0, 0.05);
  require("trouser_flare_m", c.trouser_flare_m, 0, 0.06);
  require("trouser_length", c.trouser_length, 0.2, 1);
  require("skirt_length", c.skirt_length, 0, 1);
  require("skirt_flare_m", c.skirt_flare_m, 0, 0.25);
  require("hair_m", c.hair_m, 0, 0.06);
  require("hair_length", c.hair_length, 0, 1);
  require("shoes_m", c.shoes_m, 0, 0.04);
  require("wrinkles", c.wrinkles, 0, 0.8);
}

// Smooth noise in [-1, 1]: plane waves of random direction, wavelengths of folds in cloth.
class Folds {
 public:
  explicit Folds(std::uint64_t seed) {
    Random random(seed, 77);
    for (Wave& wave : waves_) {
      const double length = random.uniform(0.07, 0.30);
      Vector3d direction(random.normal(), random.normal(), random.normal());
      wave.k = direction.normalized() * (2.0 * std::numbers::pi / length);
      wave.phase = random.uniform(0, 2.0 * std::numbers::pi);
    }
  }
  [[nodiscard]] double at(const Vector3d& p) const {
    double sum = 0;
    for (const Wave& wave : waves_) sum += std::sin(wave.k.dot(p) + wave.phase);
    return std::clamp(sum / static_cast<double>(waves_.size()) * 2.4, -1.0, 1.0);
  }

 private:
  struct Wave {
    Vector3d k;
    double phase;
  };
  std::array<Wave, 14> waves_;
};

// How far each garment stands off the skin at a point of the zero pose [m].
class Wardrobe {
 public:
  Wardrobe(const Clothing& clothing, const BoneLengths& lengths) : c_(clothing), l_(lengths) {
    hem_ = kHemShare * l_.upper_arm;
    leg_ = l_.upper_leg + l_.lower_leg;
    hip_y_ = -l_.hip_drop;
    shoulder_x_ = 0.5 * l_.shoulder_width;
  }
  [[nodiscard]] double distance(const Vector3d& p) const { return std::max({top(p), trousers(p), hair(p), shoes(p)}); }

 private:
  [[nodiscard]] double top(const Vector3d& p) const {
    const double sleeve_end = shoulder_x_ + c_.sleeve * 0.97 * (l_.upper_arm + l_.lower_arm);
    const double on_arm = smoothStep(sleeve_end + hem_, sleeve_end - hem_, std::abs(p.x()));
    const double collar = smoothStep(l_.torso + 0.35 * l_.neck_to_head, l_.torso, p.y());
    const double seam = smoothStep(hip_y_ - 0.06 * leg_ - hem_, hip_y_ - 0.06 * leg_ + hem_, p.y());
    return c_.top_m * on_arm * collar * seam;
  }
  [[nodiscard]] double trousers(const Vector3d& p) const {
    const double down = (hip_y_ - p.y()) / leg_;
    const double belt = smoothStep(0.55 * l_.spine, 0.40 * l_.spine, p.y());
    const double end = smoothStep(c_.trouser_length + 0.02, c_.trouser_length - 0.02, down);
    const double flare = c_.trouser_flare_m * smoothStep(0.1, c_.trouser_length, down);
    return (c_.trousers_m + flare) * belt * end;
  }
  [[nodiscard]] double hair(const Vector3d& p) const {
    if (c_.hair_m <= 0) return 0;
    const double n = l_.neck_to_head;
    const double above_chin = p.y() - (l_.torso + n);
    // The hair line: high over the face, down to the nape behind.
    const double line = std::clamp(0.9 * p.z() / (0.5 * n), -0.45, 0.45) * n;
    const double scalp = smoothStep(line - 0.05 * n, line + 0.25 * n, above_chin + 0.10 * n);
    const double bottom = l_.torso + n * (0.55 - 1.6 * c_.hair_length);
    const double behind = smoothStep(0.05 * n, -0.25 * n, p.z()) *
                          smoothStep(bottom - 0.2 * n, bottom + 0.4 * n, p.y()) *
                          smoothStep(0.75 * n, 0.30 * n, std::abs(p.x()));
    return c_.hair_m * std::max(scalp, c_.hair_length > 0 ? behind : 0.0);
  }
  [[nodiscard]] double shoes(const Vector3d& p) const {
    const double ankle_y = hip_y_ - leg_;
    return c_.shoes_m * smoothStep(ankle_y + 0.06 * l_.lower_leg, ankle_y - 0.02 * l_.lower_leg, p.y());
  }

  const Clothing& c_;
  BoneLengths l_;
  double hem_, leg_, hip_y_, shoulder_x_;
};

// Half-axes of the body around x = 0 at hip height, from the vertices there.
Eigen::Vector2d hipExtent(const BodySurface& body) {
  const BoneLengths& l = body.skeleton.lengths;
  Eigen::Vector2d extent(0.5 * l.hip_width, 0.5 * l.hip_width);
  for (const Eigen::Vector3f& v : body.vertices) {
    if (std::abs(static_cast<double>(v.y()) + l.hip_drop) > 0.06 * l.upper_leg) continue;
    extent = extent.cwiseMax(Eigen::Vector2d(std::abs(v.x()), std::abs(v.z())));
  }
  return extent;
}

// Where a leg's vertex lies on one half of the skirt: along the ray from the leg's axis, on the ellipse or on the
// middle plane, whichever comes first. axis_x: distance [m] of the leg's axis from the middle plane.
Vector3d onSkirt(const Vector3d& p, double axis_x, double half_width, double half_depth) {
  const double side = p.x() > 0 ? 1.0 : -1.0;
  const Eigen::Vector2d origin(axis_x, 0);
  Eigen::Vector2d direction(side * p.x() - axis_x, p.z());
  if (direction.norm() < 1e-6) return p;
  direction.normalize();
  const Eigen::Vector2d scale(1.0 / half_width, 1.0 / half_depth);
  const Eigen::Vector2d o = origin.cwiseProduct(scale);
  const Eigen::Vector2d d = direction.cwiseProduct(scale);
  const double a = d.squaredNorm();
  const double b = o.dot(d);
  const double on_ellipse = (-b + std::sqrt(std::max(0.0, b * b - a * (o.squaredNorm() - 1.0)))) / a;
  const Eigen::Vector2d outside = origin + on_ellipse * direction;
  if (outside.x() >= kMiddleGap) return {side * outside.x(), p.y(), outside.y()};
  // Stretch the inner face to the corners, so that no slit is left where the two halves meet.
  const double corner =
      half_depth * std::sqrt(std::max(0.0, 1.0 - kMiddleGap * kMiddleGap / (half_width * half_width)));
  const double z = direction.y() * (axis_x - kMiddleGap) / -direction.x();
  return {side * kMiddleGap, p.y(), std::clamp(kInnerStretch * z, -corner, corner)};
}

// The same skin with this share of each leg's weight moved to the other leg.
BodySurface::Skin sharedByLegs(const BodySurface::Skin& skin, double share) {
  constexpr std::array<std::array<int, 2>, 4> kPairs = {
      {{static_cast<int>(Bone::RightFemur), static_cast<int>(Bone::LeftFemur)},
       {static_cast<int>(Bone::RightTibia), static_cast<int>(Bone::LeftTibia)},
       {static_cast<int>(Bone::RightFoot), static_cast<int>(Bone::LeftFoot)},
       {kRightFemurUntwisted, kLeftFemurUntwisted}}};
  DenseWeights weights{};
  for (std::size_t i = 0; i < 4; ++i) weights[skin.bone[i]] += static_cast<double>(skin.weight[i]);
  for (const auto& pair : kPairs) {
    double& right = weights[static_cast<std::size_t>(pair[0])];
    double& left = weights[static_cast<std::size_t>(pair[1])];
    const double flow = share * (left - right);
    right += flow;
    left -= flow;
  }
  return packedWeights(weights);
}

class Skirt {
 public:
  Skirt(const BodySurface& body, const Clothing& clothing)
      : l_(body.skeleton.lengths), clothing_(clothing), hips_(hipExtent(body)) {}
  // Moves a vertex onto the skirt and ties it to both legs there.
  void drape(Vector3d& p, BodySurface::Skin& skin) const {
    const double leg = l_.upper_leg + l_.lower_leg;
    const double down = (-l_.hip_drop - p.y()) / leg;
    const double share =
        smoothStep(0.0, 0.14, down) * smoothStep(clothing_.skirt_length + 0.015, clothing_.skirt_length - 0.015, down);
    if (share <= 0) return;
    const double wider = 0.01 + clothing_.skirt_flare_m * down;
    const Vector3d cloth = onSkirt(p, 0.5 * l_.hip_width, hips_.x() + wider, hips_.y() + wider);
    // Cloth is never inside the leg.
    const double axis = std::copysign(0.5 * l_.hip_width, p.x());
    const double skin_radius = std::hypot(p.x() - axis, p.z());
    if (std::hypot(cloth.x() - axis, cloth.z()) > skin_radius) p += share * (cloth - p);
    const double far_side = std::clamp(std::abs(p.x()) / (0.8 * hips_.x()), 0.0, 1.0);
    skin = sharedByLegs(skin, share * 0.5 * (1.0 - far_side * far_side));
  }

 private:
  BoneLengths l_;
  const Clothing& clothing_;
  Eigen::Vector2d hips_;
};

}  // namespace

void dress(BodySurface& body, const Clothing& clothing) {
  validate(clothing);
  const std::vector<Eigen::Vector3f> normals = vertexNormals(body.vertices, body.triangles);
  const Wardrobe wardrobe(clothing, body.skeleton.lengths);
  const Skirt skirt(body, clothing);
  const Folds folds(clothing.seed);
  const double crotch_y = -body.skeleton.lengths.hip_drop - 0.15 * body.skeleton.lengths.upper_leg;
  for (std::size_t i = 0; i < body.vertices.size(); ++i) {
    const Vector3d skin = body.vertices[i].cast<double>();
    const double unevenness = 1.0 + clothing.wrinkles * folds.at(skin);
    Vector3d p = skin + normals[i].cast<double>() * (wardrobe.distance(skin) * unevenness);
    if (clothing.skirt_length > 0) skirt.drape(p, body.skin[i]);
    if (skin.y() < crotch_y && p.x() * std::copysign(1.0, skin.x()) < kMiddleGap) {
      p.x() = std::copysign(std::min(kMiddleGap, std::abs(skin.x())), skin.x());
    }
    body.vertices[i] = p.cast<float>();
  }
}

Clothing sampleClothing(Random& random) {
  // Small values often, large ones seldom.
  const auto mostly_small = [&](double largest) {
    const double u = random.uniform();
    return largest * u * u;
  };
  Clothing c;
  c.top_m = 0.003 + mostly_small(0.032);
  c.sleeve = random.uniform() < 0.5 ? 1.0 : random.uniform(0.1, 0.6);
  c.trousers_m = 0.003 + mostly_small(0.022);
  c.trouser_flare_m = mostly_small(0.035);
  c.trouser_length = random.uniform() < 0.7 ? 1.0 : random.uniform(0.25, 0.95);
  const bool wears_skirt = random.uniform() < 0.10;
  const double skirt_length = random.uniform(0.30, 0.85);
  const double skirt_flare = mostly_small(0.16);
  c.skirt_length = wears_skirt ? skirt_length : 0;
  c.skirt_flare_m = wears_skirt ? skirt_flare : 0;
  const double hair = random.uniform();
  const double thickness = random.uniform(0.004, 0.030);
  c.hair_m = hair < 0.15 ? 0.0 : thickness;
  const double length = random.uniform();
  c.hair_length = hair > 0.65 ? length : 0.0;
  c.shoes_m = random.uniform() < 0.25 ? 0.0 : random.uniform(0.003, 0.018);
  c.wrinkles = random.uniform(0.1, 0.6);
  c.seed = random.next();
  return c;
}

}  // namespace depthmocap
