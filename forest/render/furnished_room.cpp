#include "forest/render/furnished_room.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "forest/render/furniture.h"
#include "forest/render/room_occupancy.h"
#include "forest/render/shapes.h"
#include "libtracker/core/check.h"

namespace depthmocap {
namespace {

// Measures of rooms cover what is met in homes and offices; they were not tuned.
constexpr double kFlesh_m = 0.13;  // around joints: what a limb and its clothes need
// A seat's cushion gives way: its surface lies this much below the hip joints' height.
constexpr double kPelvisAboveSeat_m = 0.09;
constexpr double kStep_m = 0.03;         // of the search for the nearest free place
constexpr double kFarthest_m = 2.5;      // where that search ends
constexpr double kBeforeCamera_m = 0.9;  // nothing stands nearer than this
constexpr double kBehindCamera_m = 1.0;  // the room reaches so far behind it
constexpr int kTries = 40;               // to find a place for a piece
constexpr double kHidingShare = 0.4;     // of the low pieces of a cluttered room that may hide legs
constexpr double kLow_m = 0.65;          // how high those are
constexpr double kAtWallShare = 0.75;    // of the pieces that usually stand at a wall

class RoomBuilder {
 public:
  RoomBuilder(SceneKind kind, const RoomPeople& people, Random& random)
      : kind_(kind), people_(people), random_(random) {
    if (!people.actor.empty()) {
      points_ = bodyPoints(*people.skeleton, people.actor);
      stance_ = stanceOf(*people.skeleton, people.actor);
    } else {
      stance_.place = {0, -people.distance_m};
    }
    points_.insert(points_.end(), people.others.begin(), people.others.end());
  }

  TriangleMesh build() {
    addKeyPieces();
    addShell();
    addFurniture();
    for (const PlacedPiece& piece : pieces_) append(piece);
    return std::move(mesh_);
  }

 private:
  struct Walls {  // [m] in the room's frame, which is turned by `turn` [rad] about the camera
    double turn = 0;
    double left = 0, right = 0, back = 0, front = 0;
  };

  void append(const PlacedPiece& piece) {
    const auto first = static_cast<std::uint32_t>(mesh_.vertices.size());
    const Eigen::Isometry3f T = piece.T_world_piece.cast<float>();
    for (const Eigen::Vector3f& v : piece.mesh.vertices) mesh_.vertices.emplace_back(T * v);
    for (const Triangle& t : piece.mesh.triangles) {
      mesh_.triangles.push_back({first + t[0], first + t[1], first + t[2]});
    }
  }

  void put(PlacedPiece piece, const Eigen::Vector2d& where, double turn) {
    piece.place(where, turn, people_.floor_y);
    pieces_.push_back(std::move(piece));
  }

  // As close to the actor in this direction as nobody touches it.
  void putNear(PlacedPiece piece, const Eigen::Vector2d& direction, double turn, double margin) {
    for (double s = 0.1; s < kFarthest_m; s += kStep_m) {
      piece.place(stance_.place + s * direction, turn, people_.floor_y);
      if (piece.holdsAny(points_, margin)) continue;
      const Eigen::Vector3d camera(0, 0, 0);
      if (!piece.holds(camera, 0.3)) pieces_.push_back(std::move(piece));
      return;
    }
  }

  void addSeat(Furniture kind) {
    if (stance_.sits) {
      const double seat = std::max(0.15, stance_.pelvis_y - people_.floor_y - kPelvisAboveSeat_m);
      return put(PlacedPiece(drawSeatOf(kind, seat, random_)), stance_.place, stance_.heading);
    }
    const double seat = random_.uniform(0.38, 0.5);
    const double turn = stance_.heading + random_.uniform(-0.3, 0.3);
    putNear(PlacedPiece(drawSeatOf(kind, seat, random_)), -stance_.forward(), turn, kFlesh_m);
  }

  void addTable() {
    const double pelvis = stance_.pelvis_y - people_.floor_y;
    if (stance_.sits) addSeat(Furniture::Chair);
    const double height = stance_.sits ? pelvis + random_.uniform(0.16, 0.26) : random_.uniform(0.7, 0.95);
    PlacedPiece table(drawDesk(height, random_));
    if (stance_.sits) {  // knees go below it
      table.box.min().y() = height - 0.1;
      keep_above_ = people_.floor_y + height - 0.1;
    }
    std::vector<Eigen::Vector3d> above;
    for (const Eigen::Vector3d& p : points_) {
      if (p.y() > keep_above_) above.push_back(p);
    }
    std::swap(above, points_);
    putNear(std::move(table), stance_.forward(), stance_.heading + random_.uniform(-0.15, 0.15), 0.6 * kFlesh_m);
    std::swap(above, points_);
  }

  void addKeyPieces() {
    switch (kind_) {
      case SceneKind::Sofa:
        return addSeat(random_.uniform() < 0.75 ? Furniture::Sofa : Furniture::Armchair);
      case SceneKind::Bed:
        return addSeat(Furniture::Bed);
      case SceneKind::Chair:
        return addSeat(random_.uniform() < 0.6 ? Furniture::Chair : Furniture::OfficeChair);
      case SceneKind::Table:
        return addTable();
      case SceneKind::BehindSofa: {
        const Eigen::Vector2d to_camera = -stance_.place.normalized();
        const double turn = std::atan2(to_camera.x(), to_camera.y()) + random_.uniform(-0.2, 0.2);
        return putNear(PlacedPiece(drawSeatOf(Furniture::Sofa, random_.uniform(0.38, 0.5), random_)), to_camera, turn,
                       0.8 * kFlesh_m);
      }
      default:
        if (stance_.sits) addSeat(random_.uniform() < 0.5 ? Furniture::Chair : Furniture::Sofa);
    }
  }

  // All (x, z) that must lie within the walls.
  [[nodiscard]] std::vector<Eigen::Vector2d> inside() const {
    std::vector<Eigen::Vector2d> inside = {{0, 0}, stance_.place};
    for (const Eigen::Vector3d& p : points_) inside.emplace_back(p.x(), p.z());
    for (const PlacedPiece& piece : pieces_) {
      for (int i = 0; i < 4; ++i) {
        const Eigen::Vector3d corner((i & 1) != 0 ? piece.box.max().x() : piece.box.min().x(), 0,
                                     (i & 2) != 0 ? piece.box.max().z() : piece.box.min().z());
        const Eigen::Vector3d p = piece.T_world_piece * corner;
        inside.emplace_back(p.x(), p.z());
      }
    }
    return inside;
  }

  void addShell() {
    const bool corner = kind_ == SceneKind::Corner;
    const double side = random_.uniform() < 0.5 ? -1.0 : 1.0;
    walls_.turn = corner ? side * random_.uniform(0.6, 0.95) : random_.uniform(-0.25, 0.25);
    const Eigen::Rotation2Dd R_room_world = roomTurn(walls_.turn);
    Eigen::Vector2d low(0, 0);
    Eigen::Vector2d high(0, 0);
    for (const Eigen::Vector2d& p : inside()) {
      const Eigen::Vector2d q = R_room_world * p;
      low = low.cwiseMin(q);
      high = high.cwiseMax(q);
    }
    const auto gap = [&](bool close) { return close ? random_.uniform(0.15, 0.4) : random_.uniform(0.3, 1.8); };
    walls_.back = low.y() - gap(corner);
    walls_.left = low.x() - gap(corner && side < 0) - (corner && side < 0 ? 0.0 : random_.uniform(0.3, 1.0));
    walls_.right = high.x() + gap(corner && side > 0) + (corner && side > 0 ? 0.0 : random_.uniform(0.3, 1.0));
    walls_.front = high.y() + kBehindCamera_m;
    addWalls(people_.floor_y, people_.floor_y + std::max(random_.uniform(2.3, 2.9), 0.3 - people_.floor_y));
  }

  // (x, z) of the world to the room's frame, and a place there to the world.
  static Eigen::Rotation2Dd roomTurn(double turn) { return Eigen::Rotation2Dd(turn); }
  [[nodiscard]] Eigen::Vector2d toWorld(const Eigen::Vector2d& p_room) const {
    return roomTurn(walls_.turn).inverse() * p_room;
  }

  void addWalls(double bottom, double top) {
    const auto at = [&](double x, double z, double y) {
      const Eigen::Vector2d p = toWorld({x, z});
      return Eigen::Vector3d(p.x(), y, p.y());
    };
    const std::array<Eigen::Vector2d, 4> corners = {Eigen::Vector2d(walls_.left, walls_.back),
                                                    {walls_.right, walls_.back},
                                                    {walls_.right, walls_.front},
                                                    {walls_.left, walls_.front}};
    std::array<Eigen::Vector3d, 4> low;
    std::array<Eigen::Vector3d, 4> high;
    for (std::size_t i = 0; i < 4; ++i) {
      low[i] = at(corners[i].x(), corners[i].y(), bottom);
      high[i] = at(corners[i].x(), corners[i].y(), top);
    }
    addQuad(mesh_, {low[3], low[2], low[1], low[0]});
    addQuad(mesh_, {high[0], high[1], high[2], high[3]});
    for (std::size_t i = 0; i < 4; ++i) {
      const std::size_t next = (i + 1) % 4;
      addQuad(mesh_, {low[i], low[next], high[next], high[i]});
    }
  }

  static bool standsAtWalls(Furniture kind) {
    return kind == Furniture::Sofa || kind == Furniture::Cupboard || kind == Furniture::Shelf ||
           kind == Furniture::Curtain || kind == Furniture::Door || kind == Furniture::Bed ||
           kind == Furniture::Screen || kind == Furniture::Lamp;
  }

  // With its back to one of the three walls that the camera can see.
  void placeAtWall(PlacedPiece& piece) {
    const Eigen::AlignedBox3d& box = piece.box;
    const double behind = 0.02 - box.min().z();
    switch (random_.below(3)) {
      case 0:
        return piece.place(toWorld({random_.uniform(walls_.left, walls_.right), walls_.back + behind}), walls_.turn,
                           people_.floor_y);
      case 1:
        return piece.place(toWorld({walls_.left + behind, random_.uniform(walls_.back, 0)}),
                           walls_.turn + 0.5 * std::numbers::pi, people_.floor_y);
      default:
        return piece.place(toWorld({walls_.right - behind, random_.uniform(walls_.back, 0)}),
                           walls_.turn - 0.5 * std::numbers::pi, people_.floor_y);
    }
  }

  void placeAnywhere(PlacedPiece& piece) {
    const Eigen::Vector2d p(random_.uniform(walls_.left, walls_.right), random_.uniform(walls_.back, 0));
    piece.place(toWorld(p), random_.uniform(-std::numbers::pi, std::numbers::pi), people_.floor_y);
  }

  [[nodiscard]] bool withinWalls(const PlacedPiece& piece) const {
    constexpr double kSlack_m = 0.05;
    for (int i = 0; i < 4; ++i) {
      const Eigen::Vector3d p =
          piece.T_world_piece * Eigen::Vector3d((i & 1) != 0 ? piece.box.max().x() : piece.box.min().x(), 0,
                                                (i & 2) != 0 ? piece.box.max().z() : piece.box.min().z());
      const Eigen::Vector2d q = roomTurn(walls_.turn) * Eigen::Vector2d(p.x(), p.z());
      if (q.x() < walls_.left - kSlack_m || q.x() > walls_.right + kSlack_m || q.y() < walls_.back - kSlack_m) {
        return false;
      }
    }
    return true;
  }

  [[nodiscard]] bool isFree(const PlacedPiece& piece, bool may_hide) const {
    const Eigen::Vector3d camera(0, 0, 0);
    if (!withinWalls(piece) || piece.holds({0, people_.floor_y, 0}, kBeforeCamera_m) || piece.holds(camera, 0.5)) {
      return false;
    }
    if (std::ranges::any_of(pieces_, [&](const PlacedPiece& other) { return piece.overlaps(other); })) return false;
    if (piece.holdsAny(points_, kFlesh_m)) return false;
    return may_hide || !piece.hides(points_);
  }

  void addFurniture() {
    const bool cluttered = kind_ == SceneKind::Cluttered;
    const int count = cluttered ? 14 + static_cast<int>(random_.below(8)) : 5 + static_cast<int>(random_.below(5));
    for (int i = 0; i < count; ++i) {
      const auto kind = static_cast<Furniture>(random_.below(kFurnitureCount));
      PlacedPiece piece(drawFurniture(kind, random_));
      const bool at_wall = standsAtWalls(kind) && random_.uniform() < kAtWallShare;
      const bool may_hide = cluttered && piece.box.max().y() < kLow_m && random_.uniform() < kHidingShare;
      for (int attempt = 0; attempt < kTries; ++attempt) {
        at_wall ? placeAtWall(piece) : placeAnywhere(piece);
        if (!isFree(piece, may_hide)) continue;
        pieces_.push_back(std::move(piece));
        break;
      }
    }
  }

  SceneKind kind_;
  const RoomPeople& people_;
  Random& random_;
  std::vector<Eigen::Vector3d> points_;
  Stance stance_;
  Walls walls_;
  std::vector<PlacedPiece> pieces_;
  TriangleMesh mesh_;
  double keep_above_ = -1e9;  // [m] only what is higher keeps off a table
};

}  // namespace

TriangleMesh makeFurnishedRoom(SceneKind kind, const RoomPeople& people, Random& random) {
  DMC_CHECK(kind != SceneKind::None && kind != SceneKind::Room);
  return RoomBuilder(kind, people, random).build();
}

}  // namespace depthmocap
