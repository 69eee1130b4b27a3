#include "forest/render/furniture.h"

#include <cmath>
#include <numbers>

#include "forest/render/shapes.h"

namespace depthmocap {
namespace {

// Measures are those of usual furniture [m]; makes are drawn evenly, as no statistics of rooms are at hand.

// Roundness (shapes.h) of wood and metal, and of cushions.
constexpr double kHard = 0.08;
constexpr double kSoft = 0.35;

bool toss(Random& random, double share = 0.5) {
  return random.uniform() < share;
}

Eigen::Isometry3d at(double x, double y, double z) {
  return placed(Eigen::Matrix3d::Identity(), {x, y, z});
}

// A block by its extent.
void addBlock(TriangleMesh& mesh, const Eigen::Vector3d& low, const Eigen::Vector3d& high, double roundness) {
  const Eigen::Vector3d middle = 0.5 * (low + high);
  addSuperquadric(mesh, at(middle.x(), middle.y(), middle.z()), 0.5 * (high - low), roundness);
}

// A straight bar between two points.
void addBar(TriangleMesh& mesh, const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius) {
  const Eigen::Vector3d along = to - from;
  const Eigen::Matrix3d R = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitY(), along).toRotationMatrix();
  addSuperquadric(mesh, placed(R, 0.5 * (from + to)), {radius, 0.5 * along.norm(), radius}, 0.3);
}

void addLegs(TriangleMesh& mesh, double x, double z, double height, double radius) {
  for (const double sx : {-1.0, 1.0}) {
    for (const double sz : {-1.0, 1.0}) addBar(mesh, {sx * x, 0, sz * z}, {sx * x, height, sz * z}, radius);
  }
}

// Seat, back and arms of a sofa: x in [-width / 2, width / 2], seat from z = back to z = front.
struct Sofa {
  double width, back, front, seat, back_height, arm_height;  // [m]; arm_height 0: no arms
};

void addSofa(TriangleMesh& mesh, const Sofa& s, Random& random) {
  const double x = 0.5 * s.width;
  const double thick = random.uniform(0.12, 0.28);
  const double bottom = toss(random, 0.6) ? 0.0 : std::min(0.15, 0.4 * s.seat);
  addBlock(mesh, {-x, bottom, s.back}, {x, s.seat, s.front}, random.uniform(kHard, kSoft));
  if (s.back_height > s.seat) {
    const double lean = random.uniform(0, 0.25);
    const double half = 0.5 * (s.back_height - bottom);
    const Eigen::Matrix3d R = Eigen::AngleAxisd(-lean, Eigen::Vector3d::UnitX()).toRotationMatrix();
    addSuperquadric(mesh, placed(R, {0, bottom + half, s.back - 0.3 * thick}), {x, half, 0.5 * thick},
                    random.uniform(kHard, kSoft));
  }
  if (s.arm_height > s.seat) {
    for (const double side : {-1.0, 1.0}) {
      const double inner = side * x;
      const double outer = side * (x + random.uniform(0.08, 0.25));
      addBlock(mesh, {std::min(inner, outer), 0, s.back}, {std::max(inner, outer), s.arm_height, s.front},
               random.uniform(kHard, kSoft));
    }
  }
  const int cushions = s.width > 0.9 ? static_cast<int>(random.below(4)) : 0;
  for (int i = 0; i < cushions; ++i) {
    const double size = random.uniform(0.15, 0.26);
    const Eigen::Matrix3d R = (Eigen::AngleAxisd(random.uniform(-0.6, 0.6), Eigen::Vector3d::UnitZ()) *
                               Eigen::AngleAxisd(random.uniform(-0.6, 0.0), Eigen::Vector3d::UnitX()))
                                  .toRotationMatrix();
    addSuperquadric(mesh, placed(R, {random.uniform(-x, x), s.seat + size, s.back + 0.15}), {size, size, 0.08}, 0.5);
  }
}

void addChair(TriangleMesh& mesh, double width, double back, double front, double seat, Random& random) {
  const double x = 0.5 * width;
  const double thick = random.uniform(0.02, 0.08);
  const double radius = random.uniform(0.01, 0.03);
  const double middle = 0.5 * (back + front);
  const auto first = mesh.vertices.size();
  addLegs(mesh, x - radius, 0.5 * (front - back) - radius, seat, radius);
  for (std::size_t v = first; v < mesh.vertices.size(); ++v) mesh.vertices[v].z() += static_cast<float>(middle);
  addBlock(mesh, {-x, seat - thick, back}, {x, seat, front}, random.uniform(kHard, kSoft));
  const double top = seat + random.uniform(0.3, 0.65);
  if (toss(random)) {  // a board; otherwise bars
    addBlock(mesh, {-x, seat + (toss(random) ? 0.15 : 0.0), back - 0.03}, {x, top, back + 0.02},
             random.uniform(kHard, kSoft));
  } else {
    const int bars = 2 + static_cast<int>(random.below(4));
    for (int i = 0; i <= bars; ++i) {
      const double bx = -x + width * i / bars;
      addBar(mesh, {bx, seat, back}, {bx, top, back - 0.06}, radius);
    }
    addBar(mesh, {-x, top, back - 0.06}, {x, top, back - 0.06}, 1.5 * radius);
  }
}

void addOfficeChair(TriangleMesh& mesh, double seat, Random& random) {
  for (int i = 0; i < 5; ++i) {
    const double a = 2 * std::numbers::pi * i / 5;
    addBar(mesh, {0, 0.1, 0}, {0.3 * std::sin(a), 0.05, 0.3 * std::cos(a)}, 0.025);
  }
  addBar(mesh, {0, 0.08, 0}, {0, seat, 0}, 0.03);
  addBlock(mesh, {-0.25, seat - 0.08, -0.24}, {0.25, seat, 0.26}, kSoft);
  const double top = seat + random.uniform(0.45, 0.8);
  addBlock(mesh, {-0.22, seat + 0.1, -0.3}, {0.22, top, -0.22}, kSoft);
  if (toss(random)) addBlock(mesh, {-0.13, top + 0.02, -0.3}, {0.13, top + 0.2, -0.24}, 0.5);  // a head rest
  if (toss(random)) {
    for (const double side : {-1.0, 1.0}) {
      addBar(mesh, {side * 0.28, seat, 0}, {side * 0.28, seat + 0.22, 0}, 0.02);
      addBlock(mesh, {side * 0.28 - 0.04, seat + 0.21, -0.15}, {side * 0.28 + 0.04, seat + 0.25, 0.15}, kSoft);
    }
  }
}

// What lies and stands about on a surface.
void addClutter(TriangleMesh& mesh, double half_x, double half_z, double y, int most, Random& random) {
  const int count = static_cast<int>(random.below(static_cast<std::uint32_t>(most + 1)));
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d half{random.uniform(0.03, 0.2), random.uniform(0.02, 0.2), random.uniform(0.03, 0.15)};
    addSuperquadric(mesh,
                    placed(aboutY(random.uniform(0, std::numbers::pi)),
                           {random.uniform(-half_x, half_x), y + half.y(), random.uniform(-half_z, half_z)}),
                    half, random.uniform(kHard, 1.0));
  }
}

void addTable(TriangleMesh& mesh, Random& random) {
  const double x = random.uniform(0.3, 1.0);
  const double z = random.uniform(0.25, 0.5);
  const double height = toss(random, 0.35) ? random.uniform(0.35, 0.55) : random.uniform(0.68, 1.05);
  const double leg = random.uniform(0.02, 0.05);
  if (toss(random, 0.2)) {
    addBar(mesh, {0, 0, 0}, {0, height, 0}, 0.05);
  } else if (toss(random, 0.25)) {
    addBlock(mesh, {-x, 0, -z}, {-x + 0.4, height, z}, kHard);  // a desk with drawers
    addBlock(mesh, {x - 0.04, 0, -z}, {x, height, z}, kHard);
  } else {
    addLegs(mesh, x - leg, z - leg, height, leg);
  }
  addBlock(mesh, {-x, height - random.uniform(0.02, 0.08), -z}, {x, height, z}, toss(random) ? kHard : 0.6);
  addClutter(mesh, x, z, height, 6, random);
}

void addBed(TriangleMesh& mesh, double top, Random& random) {
  const double x = random.uniform(0.95, 1.05);
  const double z = random.uniform(0.4, 0.95);
  addBlock(mesh, {-x, 0, -z}, {x, top, z}, random.uniform(kHard, 0.25));
  addBlock(mesh, {-x, top, -0.8 * z}, {-x + 0.4, top + random.uniform(0.05, 0.15), 0.8 * z}, 0.5);
  if (toss(random)) addBlock(mesh, {-x - 0.06, 0, -z}, {-x, top + random.uniform(0.2, 0.6), z}, kHard);
  const int folds = static_cast<int>(random.below(5));  // a blanket
  for (int i = 0; i < folds; ++i) {
    const Eigen::Vector3d half{random.uniform(0.2, 0.7), random.uniform(0.03, 0.14), random.uniform(0.1, 0.4)};
    addSuperquadric(
        mesh,
        placed(aboutY(random.uniform(-0.6, 0.6)), {random.uniform(-0.3, 0.8) * x, top, random.uniform(-0.5, 0.5) * z}),
        half, random.uniform(0.5, 1.0));
  }
}

void addCupboard(TriangleMesh& mesh, Random& random) {
  const double x = random.uniform(0.2, 0.9);
  const double height = random.uniform(0.5, 2.2);
  addBlock(mesh, {-x, 0, -0.25}, {x, height, random.uniform(0.0, 0.3)}, kHard);
  addClutter(mesh, x, 0.2, height, 4, random);
}

void addShelf(TriangleMesh& mesh, Random& random) {
  const double x = random.uniform(0.25, 0.7);
  const double height = random.uniform(0.8, 2.1);
  const int boards = 3 + static_cast<int>(random.below(4));
  for (const double side : {-1.0, 1.0})
    addBlock(mesh, {side * x - 0.02, 0, -0.16}, {side * x + 0.02, height, 0.16}, kHard);
  for (int i = 0; i <= boards; ++i) {
    const double y = height * i / boards;
    addBlock(mesh, {-x, y - 0.02, -0.16}, {x, y + 0.02, 0.16}, kHard);
    if (i < boards) addClutter(mesh, x - 0.1, 0.08, y + 0.02, 4, random);
  }
  if (toss(random)) addBlock(mesh, {-x, 0, -0.18}, {x, height, -0.16}, kHard);
}

// A sheet with folds that hangs from its upper edge.
void addCurtain(TriangleMesh& mesh, Random& random) {
  constexpr int kStrips = 40;
  const double width = random.uniform(0.5, 2.2);
  const double height = random.uniform(1.6, 2.6);
  const double depth = random.uniform(0.02, 0.1);
  const double folds = random.uniform(3, 9) * width;
  const auto edge = [&](int i, double y, double spread) {
    const double t = static_cast<double>(i) / kStrips;
    return Eigen::Vector3d((t - 0.5) * width, y, spread * depth * std::sin(2 * std::numbers::pi * folds * t));
  };
  for (int i = 0; i < kStrips; ++i) {
    addQuad(mesh, {edge(i, 0, 1.2), edge(i + 1, 0, 1.2), edge(i + 1, height, 0.6), edge(i, height, 0.6)});
  }
}

void addPlant(TriangleMesh& mesh, Random& random) {
  const double pot = random.uniform(0.1, 0.4);
  addBlock(mesh, {-0.15, 0, -0.15}, {0.15, pot, 0.15}, 0.8);
  const double height = random.uniform(0.4, 1.8);
  addBar(mesh, {0, pot, 0}, {0, pot + 0.6 * height, 0}, 0.02);
  const int leaves = 10 + static_cast<int>(random.below(25));
  const double spread = random.uniform(0.15, 0.5);
  for (int i = 0; i < leaves; ++i) {
    const Eigen::Quaterniond q(random.normal(), random.normal(), random.normal(), random.normal());
    addSuperquadric(mesh,
                    placed(q.normalized().toRotationMatrix(),
                           {spread * random.normal() * 0.6, pot + height * random.uniform(0.2, 1.0),
                            spread * random.normal() * 0.6}),
                    {random.uniform(0.05, 0.2), random.uniform(0.02, 0.07), 0.004}, 0.8);
  }
}

void addLamp(TriangleMesh& mesh, Random& random) {
  const double height = random.uniform(0.9, 1.8);
  addBlock(mesh, {-0.15, 0, -0.15}, {0.15, 0.04, 0.15}, 0.8);
  addBar(mesh, {0, 0, 0}, {0, height, 0}, 0.015);
  const double r = random.uniform(0.1, 0.25);
  addBlock(mesh, {-r, height - 0.05, -r}, {r, height + random.uniform(0.15, 0.35), r}, random.uniform(0.4, 1.0));
}

// A stand with a coat and a hat: what is most like a person.
void addCoatStand(TriangleMesh& mesh, Random& random) {
  const double height = random.uniform(1.5, 1.9);
  addBar(mesh, {0, 0, 0}, {0, height, 0}, 0.025);
  for (int i = 0; i < 3; ++i) {
    const double a = 2 * std::numbers::pi * i / 3;
    addBar(mesh, {0, 0.2, 0}, {0.3 * std::sin(a), 0, 0.3 * std::cos(a)}, 0.02);
  }
  const int coats = 1 + static_cast<int>(random.below(3));
  for (int i = 0; i < coats; ++i) {
    const double length = random.uniform(0.5, 1.1);
    const Eigen::Vector3d half{random.uniform(0.12, 0.28), 0.5 * length, random.uniform(0.05, 0.14)};
    addSuperquadric(mesh,
                    placed(aboutY(random.uniform(0, 6)),
                           {random.uniform(-0.15, 0.15), height - 0.1 - half.y(), random.uniform(-0.15, 0.15)}),
                    half, random.uniform(0.3, 1.0));
  }
}

void addScreen(TriangleMesh& mesh, Random& random) {
  const double x = random.uniform(0.2, 0.8);
  const double y = random.uniform(0.2, 0.5);
  const double low = toss(random) ? random.uniform(0.0, 0.3) : random.uniform(0.5, 1.2);
  addBlock(mesh, {-x, low, -0.03}, {x, low + 2 * y, 0.03}, kHard);
  addBar(mesh, {0, 0, -0.05}, {0, low + y, -0.05}, 0.04);
  addBlock(mesh, {-0.6 * x, 0, -0.2}, {0.6 * x, 0.04, 0.2}, kHard);
}

void addPet(TriangleMesh& mesh, Random& random) {
  const double s = random.uniform(0.5, 1.6);  // a cat .. a large dog
  const double back = 0.4 * s;
  addBlock(mesh, {-0.3 * s, back - 0.22 * s, -0.1 * s}, {0.3 * s, back, 0.1 * s}, 0.9);
  addLegs(mesh, 0.22 * s, 0.06 * s, back - 0.1 * s, 0.03 * s);
  addBlock(mesh, {0.26 * s, back - 0.05 * s, -0.07 * s}, {0.46 * s, back + 0.13 * s, 0.07 * s}, 0.9);
  addBar(mesh, {-0.28 * s, back - 0.05 * s, 0}, {-0.5 * s, back + 0.1 * s, 0}, 0.02 * s);
}

// Boxes, bags and balls on top of each other.
void addHeap(TriangleMesh& mesh, Random& random) {
  double y = 0;
  const int count = 1 + static_cast<int>(random.below(5));
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d half{random.uniform(0.06, 0.4), random.uniform(0.05, 0.35), random.uniform(0.06, 0.3)};
    if (y + 2 * half.y() > 2.0) break;
    addSuperquadric(
        mesh,
        placed(aboutY(random.uniform(0, 6)), {random.uniform(-0.1, 0.1), y + half.y(), random.uniform(-0.1, 0.1)}),
        half, random.uniform(kHard, 1.0));
    y += 2 * half.y() * random.uniform(0.8, 1.0);
  }
}

void addDoor(TriangleMesh& mesh, Random& random) {
  const double x = random.uniform(0.35, 0.5);
  const double height = random.uniform(1.9, 2.1);
  for (const double side : {-1.0, 1.0})
    addBlock(mesh, {side * x - 0.05, 0, -0.08}, {side * x + 0.05, height, 0.08}, kHard);
  addBlock(mesh, {-x, height - 0.05, -0.08}, {x, height + 0.05, 0.08}, kHard);
  const double open = random.uniform(0, 1.6);
  const Eigen::Isometry3d T =
      at(-x, 0.5 * height, 0) * Eigen::Isometry3d(Eigen::AngleAxisd(-open, Eigen::Vector3d::UnitY()));
  addSuperquadric(mesh, T * at(x, 0, 0), {x, 0.5 * height, 0.02}, kHard);
}

Sofa drawSofa(double width, double seat, Random& random) {
  return {width, -random.uniform(0.25, 0.35),      random.uniform(0.25, 0.6),
          seat,  seat + random.uniform(0.25, 0.6), toss(random, 0.7) ? seat + random.uniform(0.1, 0.25) : 0};
}

}  // namespace

TriangleMesh drawFurniture(Furniture kind, Random& random) {
  TriangleMesh mesh;
  switch (kind) {
    case Furniture::Sofa:
      addSofa(mesh, drawSofa(random.uniform(1.2, 2.4), random.uniform(0.35, 0.48), random), random);
      break;
    case Furniture::Armchair:
      addSofa(mesh, drawSofa(random.uniform(0.5, 0.7), random.uniform(0.35, 0.48), random), random);
      break;
    case Furniture::Chair:
      addChair(mesh, random.uniform(0.38, 0.5), -0.22, 0.22, random.uniform(0.42, 0.5), random);
      break;
    case Furniture::OfficeChair:
      addOfficeChair(mesh, random.uniform(0.4, 0.55), random);
      break;
    case Furniture::Stool:
      addLegs(mesh, 0.14, 0.14, random.uniform(0.4, 0.75), 0.02);
      addBlock(mesh, {-0.18, 0.42, -0.18}, {0.18, 0.5, 0.18}, 0.7);
      break;
    case Furniture::Bed:
      addBed(mesh, random.uniform(0.3, 0.65), random);
      break;
    case Furniture::Table:
      addTable(mesh, random);
      break;
    case Furniture::Cupboard:
      addCupboard(mesh, random);
      break;
    case Furniture::Shelf:
      addShelf(mesh, random);
      break;
    case Furniture::Curtain:
      addCurtain(mesh, random);
      break;
    case Furniture::Door:
      addDoor(mesh, random);
      break;
    case Furniture::Plant:
      addPlant(mesh, random);
      break;
    case Furniture::Lamp:
      addLamp(mesh, random);
      break;
    case Furniture::CoatStand:
      addCoatStand(mesh, random);
      break;
    case Furniture::Screen:
      addScreen(mesh, random);
      break;
    case Furniture::Pet:
      addPet(mesh, random);
      break;
    case Furniture::Heap:
      addHeap(mesh, random);
      break;
  }
  return mesh;
}

TriangleMesh drawSeat(double seat_m, Random& random) {
  TriangleMesh mesh;
  const double choice = random.uniform();
  if (choice < 0.45) {
    Sofa sofa = drawSofa(toss(random, 0.6) ? random.uniform(1.2, 2.4) : random.uniform(0.5, 0.75), seat_m, random);
    sofa.back = -random.uniform(0.2, 0.32);
    sofa.front = random.uniform(0.2, 0.38);
    addSofa(mesh, sofa, random);
    if (sofa.width > 1.2) {  // not always in the middle
      const auto shift = static_cast<float>(random.uniform(-0.35, 0.35) * sofa.width);
      for (Eigen::Vector3f& v : mesh.vertices) v.x() += shift;
    }
  } else if (choice < 0.7) {
    addChair(mesh, random.uniform(0.38, 0.5), -0.22, random.uniform(0.15, 0.28), seat_m, random);
  } else if (choice < 0.82) {
    addOfficeChair(mesh, seat_m, random);
  } else if (choice < 0.88) {
    return drawSeatOf(Furniture::Bed, seat_m, random);
  } else if (choice < 0.94) {  // a mattress, a bench, a step
    const double x = random.uniform(0.4, 1.1);
    addBlock(mesh, {-x, 0, -random.uniform(0.2, 1.2)}, {x, seat_m, random.uniform(0.1, 0.35)},
             random.uniform(kHard, kSoft));
  } else {
    addLegs(mesh, 0.14, 0.14, seat_m, 0.02);
    addBlock(mesh, {-0.18, seat_m - 0.05, -0.18}, {0.18, seat_m, 0.18}, 0.7);
  }
  return mesh;
}

TriangleMesh drawSeatOf(Furniture kind, double seat_m, Random& random) {
  TriangleMesh mesh;
  if (kind == Furniture::Chair) {
    addChair(mesh, random.uniform(0.38, 0.5), -0.22, random.uniform(0.15, 0.28), seat_m, random);
  } else if (kind == Furniture::OfficeChair) {
    addOfficeChair(mesh, seat_m, random);
  } else if (kind == Furniture::Bed) {
    addBed(mesh, seat_m, random);
    float front = 0;
    for (const Eigen::Vector3f& v : mesh.vertices) front = std::max(front, v.z());
    for (Eigen::Vector3f& v : mesh.vertices) v.z() -= front - 0.25F;
  } else {
    const bool wide = kind == Furniture::Sofa;
    Sofa sofa = drawSofa(wide ? random.uniform(1.4, 2.4) : random.uniform(0.5, 0.75), seat_m, random);
    sofa.back = -random.uniform(0.2, 0.32);
    sofa.front = random.uniform(0.2, 0.38);
    addSofa(mesh, sofa, random);
    const auto shift = static_cast<float>(wide ? random.uniform(-0.3, 0.3) * sofa.width : 0.0);
    for (Eigen::Vector3f& v : mesh.vertices) v.x() += shift;
  }
  return mesh;
}

TriangleMesh drawDesk(double height_m, Random& random) {
  TriangleMesh mesh;
  const double x = random.uniform(0.45, 0.9);
  const double z = random.uniform(0.3, 0.45);
  const double leg = random.uniform(0.02, 0.04);
  addLegs(mesh, x - leg, z - leg, height_m, leg);
  addBlock(mesh, {-x, height_m - random.uniform(0.02, 0.06), -z}, {x, height_m, z}, toss(random) ? kHard : 0.6);
  addClutter(mesh, 0.9 * x, 0.5 * z, height_m, 4, random);
  return mesh;
}

TriangleMesh drawCouch(double top_m, Random& random) {
  TriangleMesh mesh;
  if (toss(random)) {
    addBed(mesh, top_m, random);
  } else {
    addSofa(mesh, drawSofa(2.0, top_m, random), random);
  }
  return mesh;
}

}  // namespace depthmocap
