#include "libtracker/segment/refine_mask.h"

#include <cmath>

#include <gtest/gtest.h>

#include "libtracker/core/random.h"
#include "libtracker/segment/depth_noise.h"
#include "libtracker/segment/find_floor.h"

namespace depthmocap {
namespace {

constexpr int kOpen = 2;

// Some surface at 2 to 4 m with steps, holes and noise; every fourth component is the actor's.
struct Scene {
  CameraModel camera{330, 244, 280, 290, 164.5, 121.5};
  DepthImage depth{330, 244, 0.0F};
  CoarseCloud cloud;
  std::vector<std::int32_t> labels;
  std::vector<std::uint8_t> selected{1, 0, 0, 1};
  RefineLimits limits{0.4, 3.8, 0.1, 0.02, Eigen::Vector4f(0, -0.98F, -0.199F, 1.2F)};

  explicit Scene(std::uint64_t seed) {
    Random random(seed);
    for (int y = 0; y < depth.height; ++y) {
      for (int x = 0; x < depth.width; ++x) {
        const double step = (x / 40 + y / 33) % 3 == 0 ? 0.5 : 0.0;
        const double z = 2.6 + step + 0.004 * y + 0.03 * random.normal();
        depth.at(x, y) = random.uniform() < 0.1 ? 0.0F : static_cast<float>(z);
      }
    }
    buildCoarseCloud(depth, camera, limits.min_depth_m, limits.max_depth_m, cloud);
    for (std::size_t i = 0; i < cloud.points.size(); ++i) {
      const bool measured = cloud.points[i].z() > 0;
      labels.push_back(measured && random.uniform() < 0.9 ? static_cast<std::int32_t>(random.below(4)) : kNoComponent);
    }
  }

  [[nodiscard]] bool isActor(std::size_t i) const {
    return labels[i] != kNoComponent && selected[static_cast<std::size_t>(labels[i])] != 0;
  }
};

// What one pixel is by the definition: 0, 1, or open.
int decided(const Scene& s, int x, int y) {
  const float z = s.depth.at(x, y);
  if (!(z > 0 && z >= 0.4F && z <= 3.8F)) return 0;
  const Eigen::Vector3d p = s.camera.unproject(x, y, static_cast<double>(z));
  const Eigen::Vector4f floor = *s.limits.floor;
  const double above = floor.head<3>().cast<double>().dot(p) + static_cast<double>(floor[3]);
  if (above < static_cast<double>(floorTolerance(s.limits.floor_distance_m, floor, z))) return 0;
  const int cx = static_cast<int>(std::floor((x - s.cloud.offset) / static_cast<double>(s.cloud.stride)));
  const int cy = static_cast<int>(std::floor((y - s.cloud.offset) / static_cast<double>(s.cloud.stride)));
  float nearest = 0.1F * gapGrowth(z);
  int answer = kOpen;
  int measured = 0;
  bool any_actor = false;
  for (int k = 0; k < 4; ++k) {
    const int nx = cx + (k & 1);
    const int ny = cy + (k >> 1);
    if (nx < 0 || ny < 0 || nx >= s.cloud.width || ny >= s.cloud.height) continue;
    const std::size_t i = s.cloud.index(nx, ny);
    if (!(s.cloud.points[i].z() > 0)) continue;
    ++measured;
    any_actor |= s.isActor(i);
    const float apart = std::abs(s.cloud.points[i].z() - z);
    if (apart > nearest) continue;
    nearest = apart;
    answer = s.isActor(i) ? 1 : 0;
  }
  return measured > 0 && !any_actor ? 0 : answer;
}

TEST(RefineMask, IsItsDefinitionPixelByPixel) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const Scene scene(seed);
    MaskImage mask;
    const PixelBox box =
        refineMask(scene.depth, scene.camera, scene.cloud, scene.labels, scene.selected, scene.limits, mask);
    int actors = 0;
    for (int y = box.y0; y < box.y1; ++y) {
      for (int x = box.x0; x < box.x1; ++x) {
        const int expected = decided(scene, x, y);
        if (expected == kOpen) continue;  // joins neighbours, or nobody
        ASSERT_EQ(mask.at(x, y), expected) << x << ' ' << y;
        actors += expected;
      }
    }
    EXPECT_GT(actors, 300);
  }
}

TEST(RefineMask, OpenPixelsJoinTheMaskAlongASurface) {
  const CameraModel camera{32, 32, 30, 30, 15.5, 15.5};
  CoarseCloud cloud;
  cloud.stride = 8;
  cloud.offset = 4;
  cloud.width = cloud.height = 4;
  cloud.points.assign(16, Eigen::Vector3f::Zero());
  cloud.points[5] = Eigen::Vector3f(0, 0, 2);  // pixel (12, 12)
  std::vector<std::int32_t> labels(16, kNoComponent);
  labels[5] = 0;
  DepthImage depth(32, 32, 0.0F);
  for (int k = 0; k < 8; ++k) depth.at(12 + k, 12) = 2.0F + 0.015F * static_cast<float>(k);  // leaves the gap of 5 cm
  depth.at(30, 30) = 2.0F;
  MaskImage mask;
  refineMask(depth, camera, cloud, labels, {1}, {0.4, 6.0, 0.05, 0.02, {}}, mask);
  for (int k = 0; k < 8; ++k) EXPECT_EQ(mask.at(12 + k, 12), 1) << k;
  EXPECT_EQ(mask.at(30, 30), 0) << "nothing reaches it";
}

TEST(RefineMask, OfNobodyIsEmpty) {
  const Scene scene(4);
  MaskImage mask;
  refineMask(scene.depth, scene.camera, scene.cloud, scene.labels, {0, 0, 0, 0}, scene.limits, mask);
  EXPECT_EQ(mask.width, scene.depth.width);
  for (const std::uint8_t value : mask.data) ASSERT_EQ(value, 0);
}

}  // namespace
}  // namespace depthmocap
