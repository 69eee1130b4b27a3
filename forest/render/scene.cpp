#include "forest/render/scene.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "forest/render/shapes.h"
#include "libtracker/core/check.h"
#include "libtracker/core/random.h"

namespace depthmocap {
namespace {

constexpr double kReach_m = 1.1;      // an actor's arm and a step
constexpr double kSightline_m = 0.6;  // half the width kept free between camera and actor
constexpr double kWallHeight_m = 2.6;
constexpr double kBehindCamera_m = 1.0;  // the room reaches so far behind the camera

// A piece of furniture stands on the floor with its middle at the origin of its frame: x along its front, y up from the
// floor, z to its front.
using Piece = std::vector<Box>;

Piece table(double width, double depth, double height) {
  const double x = 0.5 * width;
  const double z = 0.5 * depth;
  const double leg = 0.06;
  return {{{-x, height - 0.04, -z}, {x, height, z}},
          {{-x, 0, -z}, {-x + leg, height - 0.04, -z + leg}},
          {{x - leg, 0, -z}, {x, height - 0.04, -z + leg}},
          {{-x, 0, z - leg}, {-x + leg, height - 0.04, z}},
          {{x - leg, 0, z - leg}, {x, height - 0.04, z}}};
}

Piece chair() {
  Piece piece = table(0.45, 0.45, 0.46);
  piece.push_back({{-0.225, 0.46, -0.225}, {0.225, 0.92, -0.185}});
  return piece;
}

Piece sofa(double width) {
  const double x = 0.5 * width;
  return {{{-x, 0, -0.42}, {x, 0.42, 0.42}},
          {{-x, 0.42, -0.42}, {x, 0.85, -0.2}},
          {{-x, 0.42, -0.2}, {-x + 0.18, 0.62, 0.42}},
          {{x - 0.18, 0.42, -0.2}, {x, 0.62, 0.42}}};
}

Piece cupboard(double width, double height) {
  return {{{-0.5 * width, 0, -0.2}, {0.5 * width, height, 0.2}}};
}

double radiusOf(const Piece& piece) {
  double radius = 0;
  for (const Box& box : piece) {
    radius = std::max({radius, box.low.cwiseProduct(Eigen::Vector3d(1, 0, 1)).norm(),
                       box.high.cwiseProduct(Eigen::Vector3d(1, 0, 1)).norm()});
  }
  return radius;
}

double distanceToSegment(const Eigen::Vector2d& p, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const Eigen::Vector2d along = b - a;
  const double length2 = along.squaredNorm();
  const double t = length2 > 0 ? std::clamp((p - a).dot(along) / length2, 0.0, 1.0) : 0.0;
  return (p - a - t * along).norm();
}

// The room's footprint: x in [left, right], z in [back, front] [m].
struct Footprint {
  double left, right, back, front;
};

// All in the floor's plane, (x, z) [m].
class Placement {
 public:
  Placement(const std::vector<Eigen::Vector3d>& path, const Footprint& room) : room_(room) {
    for (const Eigen::Vector3d& p : path) path_.emplace_back(p.x(), p.z());
  }

  // A free place for something of this radius; nothing after many tries.
  std::optional<Eigen::Vector2d> find(double radius, Random& random) {
    constexpr int kTries = 200;
    for (int i = 0; i < kTries; ++i) {
      const Eigen::Vector2d p(random.uniform(room_.left + radius, room_.right - radius),
                              random.uniform(room_.back + radius, -0.5));
      if (!isFree(p, radius)) continue;
      taken_.push_back({p, radius});
      return p;
    }
    return std::nullopt;
  }

 private:
  struct Disc {
    Eigen::Vector2d center;
    double radius;
  };

  [[nodiscard]] bool isFree(const Eigen::Vector2d& p, double radius) const {
    const Eigen::Vector2d camera(0, 0);
    for (const Eigen::Vector2d& actor : path_) {
      if ((p - actor).norm() < radius + kReach_m) return false;
      if (distanceToSegment(p, camera, actor) < radius + kSightline_m) return false;
    }
    return std::ranges::none_of(taken_, [&](const Disc& d) { return (p - d.center).norm() < radius + d.radius; });
  }

  std::vector<Eigen::Vector2d> path_;
  std::vector<Disc> taken_;
  Footprint room_;
};

Footprint drawFootprint(const std::vector<Eigen::Vector3d>& path, Random& random) {
  Footprint room{-0.5, 0.5, 0.0, kBehindCamera_m};
  for (const Eigen::Vector3d& p : path) {
    room.left = std::min(room.left, p.x());
    room.right = std::max(room.right, p.x());
    room.back = std::min(room.back, p.z());
  }
  room.left -= random.uniform(1.4, 2.4);
  room.right += random.uniform(1.4, 2.4);
  room.back -= random.uniform(1.3, 2.3);
  return room;
}

void addShell(TriangleMesh& mesh, const Footprint& r, double floor_y) {
  const double top = floor_y + kWallHeight_m;
  addQuad(mesh, {{{r.left, floor_y, r.front},
                  {r.right, floor_y, r.front},
                  {r.right, floor_y, r.back},
                  {r.left, floor_y, r.back}}});
  addQuad(mesh,
          {{{r.left, floor_y, r.back}, {r.right, floor_y, r.back}, {r.right, top, r.back}, {r.left, top, r.back}}});
  addQuad(mesh,
          {{{r.left, floor_y, r.front}, {r.left, floor_y, r.back}, {r.left, top, r.back}, {r.left, top, r.front}}});
  addQuad(mesh,
          {{{r.right, floor_y, r.back}, {r.right, floor_y, r.front}, {r.right, top, r.front}, {r.right, top, r.back}}});
}

}  // namespace

TriangleMesh makeRoom(double floor_y, const std::vector<Eigen::Vector3d>& path, std::uint64_t seed) {
  DMC_CHECK(!path.empty());
  Random random(seed);
  const Footprint room = drawFootprint(path, random);
  TriangleMesh mesh;
  addShell(mesh, room, floor_y);

  Placement placement(path, room);
  const std::array<Piece, 4> pieces = {sofa(random.uniform(1.3, 1.8)), table(random.uniform(0.8, 1.2), 0.7, 0.74),
                                       chair(), cupboard(random.uniform(0.6, 1.0), random.uniform(1.0, 1.9))};
  for (const Piece& piece : pieces) {
    const std::optional<Eigen::Vector2d> place = placement.find(radiusOf(piece), random);
    const double turn = random.uniform(-std::numbers::pi, std::numbers::pi);
    if (!place) continue;
    const Eigen::Isometry3d T_world_piece =
        Eigen::Translation3d(place->x(), floor_y, place->y()) * Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitY());
    for (const Box& box : piece) addBox(mesh, box, T_world_piece);
  }
  return mesh;
}

}  // namespace depthmocap
