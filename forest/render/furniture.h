#pragma once
#include <array>
#include <string_view>

#include "forest/render/depth_renderer.h"
#include "libtracker/core/random.h"

namespace depthmocap {

enum class Furniture {
  Sofa,
  Armchair,
  Chair,
  OfficeChair,
  Stool,
  Bed,
  Table,
  Cupboard,
  Shelf,
  Curtain,
  Door,
  Plant,
  Lamp,
  CoatStand,
  Screen,
  Pet,
  Heap,
};
inline constexpr int kFurnitureCount = 17;

// One piece of random size and make in a frame of its own: it stands on the floor (y = 0) with its middle at the
// origin, x along its front, y up, z to its front. Without parts.
TriangleMesh drawFurniture(Furniture kind, Random& random);

// What somebody sits on: as above, but its seat is `seat_m` [m] above the floor and the sitter's pelvis above the
// origin; the seat's front edge is about 0.3 m before it. Height 0.15 .. 0.9 m.
TriangleMesh drawSeat(double seat_m, Random& random);

// The same of one kind: Sofa, Armchair, Chair, OfficeChair or Bed, which one sits on at its edge.
TriangleMesh drawSeatOf(Furniture kind, double seat_m, Random& random);

// A table of this height [m] to sit or stand at, with things on it.
TriangleMesh drawDesk(double height_m, Random& random);

// What somebody lies on, its top `top_m` [m] above the floor, its middle at the origin, long along x.
TriangleMesh drawCouch(double top_m, Random& random);

}  // namespace depthmocap
