#include "forest/render/shapes.h"

#include <cmath>
#include <numbers>

namespace depthmocap {
namespace {

// Facets of a superquadric from pole to pole and around: its silhouette is smooth to about 2 % of its size.
constexpr int kRings = 8;
constexpr int kSectors = 16;

double signedPower(double value, double exponent) {
  return std::copysign(std::pow(std::abs(value), exponent), value);
}

}  // namespace

void addQuad(TriangleMesh& mesh, const std::array<Eigen::Vector3d, 4>& corners) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const Eigen::Vector3d& corner : corners) mesh.vertices.push_back(corner.cast<float>());
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangles.push_back({first, first + 2, first + 3});
}

void addBox(TriangleMesh& mesh, const Box& box, const Eigen::Isometry3d& T_world_box) {
  const auto corner = [&](int i) {
    return T_world_box * Eigen::Vector3d((i & 1) != 0 ? box.high.x() : box.low.x(),
                                         (i & 2) != 0 ? box.high.y() : box.low.y(),
                                         (i & 4) != 0 ? box.high.z() : box.low.z());
  };
  constexpr std::array<std::array<int, 4>, 6> kFaces = {
      {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
  for (const auto& f : kFaces) addQuad(mesh, {corner(f[0]), corner(f[1]), corner(f[2]), corner(f[3])});
}

void addSuperquadric(TriangleMesh& mesh, const Eigen::Isometry3d& T_world_thing, const Eigen::Vector3d& half,
                     double roundness) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (int ring = 0; ring <= kRings; ++ring) {
    const double v = std::numbers::pi * (static_cast<double>(ring) / kRings - 0.5);
    const double around = signedPower(std::cos(v), roundness);
    for (int sector = 0; sector < kSectors; ++sector) {
      const double u = 2.0 * std::numbers::pi * sector / kSectors;
      const Eigen::Vector3d unit(around * signedPower(std::cos(u), roundness), signedPower(std::sin(v), roundness),
                                 around * signedPower(std::sin(u), roundness));
      mesh.vertices.push_back((T_world_thing * half.cwiseProduct(unit)).cast<float>());
    }
  }
  for (std::uint32_t ring = 0; ring < kRings; ++ring) {
    for (std::uint32_t sector = 0; sector < kSectors; ++sector) {
      const std::uint32_t a = first + ring * kSectors + sector;
      const std::uint32_t b = first + ring * kSectors + (sector + 1) % kSectors;
      mesh.triangles.push_back({a, a + kSectors, b});
      mesh.triangles.push_back({b, a + kSectors, b + kSectors});
    }
  }
}

void fillParts(TriangleMesh& mesh, std::uint8_t part) {
  mesh.part.resize(mesh.triangles.size(), part);
}

Eigen::Isometry3d placed(const Eigen::Matrix3d& R, const Eigen::Vector3d& p) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = R;
  T.translation() = p;
  return T;
}

Eigen::Matrix3d aboutY(double angle) {
  return Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitY()).toRotationMatrix();
}

}  // namespace depthmocap
