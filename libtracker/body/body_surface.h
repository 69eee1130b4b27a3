#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "libtracker/core/parts.h"
#include "libtracker/skeleton/skeleton.h"

namespace depthmocap {

enum class Sex { Male, Female };

// What a body is made from.
struct BodyShape {
  Sex sex = Sex::Male;
  double stature_m = 1.75;  // [m] (1.0 .. 2.2)
  double weight_kg = 72;    // [kg] (30 .. 160)
};

// A closed surface around a skeleton in its zero pose, with linear blend skinning weights and parts.
struct BodySurface {
  struct Skin {
    std::array<std::uint8_t, 4> bone{};  // Bone
    std::array<float, 4> weight{};       // sums to 1; unused entries 0
  };
  Skeleton skeleton;
  std::vector<Eigen::Vector3f> vertices;                // [m] in the zero pose with the root at the origin
  std::vector<Skin> skin;                               // one a vertex
  std::vector<std::array<std::uint32_t, 3>> triangles;  // counter-clockwise from outside
  std::vector<std::uint8_t> part;                       // Part, one a triangle
};

}  // namespace depthmocap
