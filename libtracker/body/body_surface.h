#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "depthmocap/body_shape.h"
#include "depthmocap/parts.h"
#include "libtracker/skeleton/skeleton.h"

namespace depthmocap {

// What a body is made from.
struct BodyShape {
  Sex sex = Sex::Male;
  double stature_m = 1.75;  // [m] (1.0 .. 2.2)
  double weight_kg = 72;    // [kg] (30 .. 160)
};

// What a vertex can be attached to: the 16 bones, and the upper arms and thighs without their twist. A limb's twist
// grows from its root to its end, as skin does on people; with the bare bone the shoulder would wring like a sweet's
// wrapper.
inline constexpr int kSkinBoneCount = kBoneCount + 4;
inline constexpr int kRightHumerusUntwisted = kBoneCount;
inline constexpr int kLeftHumerusUntwisted = kBoneCount + 1;
inline constexpr int kRightFemurUntwisted = kBoneCount + 2;
inline constexpr int kLeftFemurUntwisted = kBoneCount + 3;

// A closed surface around a skeleton in its zero pose, with linear blend skinning weights and parts.
struct BodySurface {
  struct Skin {
    std::array<std::uint8_t, 4> bone{};  // Bone, or one of the untwisted bones above; heaviest first
    std::array<float, 4> weight{};       // sums to 1; unused entries 0
  };
  Skeleton skeleton;
  std::vector<Eigen::Vector3f> vertices;                // [m] in the zero pose with the root at the origin
  std::vector<Skin> skin;                               // one per vertex
  std::vector<std::array<std::uint32_t, 3>> triangles;  // counter-clockwise from outside
  std::vector<std::uint8_t> part;                       // Part, one per triangle
};

// The weight of one litre of a living body with half-filled lungs [kg].
inline constexpr double kBodyDensityKgPerLitre = 1.0 / 0.985;

// Volume [m^3] that a closed surface encloses (divergence theorem).
double enclosedVolume(const std::vector<Eigen::Vector3f>& vertices,
                      const std::vector<std::array<std::uint32_t, 3>>& triangles);

// Unit normals, one per vertex, area-weighted over its triangles; zero where a vertex has none.
std::vector<Eigen::Vector3f> vertexNormals(const std::vector<Eigen::Vector3f>& vertices,
                                           const std::vector<std::array<std::uint32_t, 3>>& triangles);

}  // namespace depthmocap
