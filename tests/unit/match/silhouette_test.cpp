#include "libtracker/match/silhouette.h"

#include <limits>

#include <gtest/gtest.h>

#include "libtracker/core/random.h"

namespace depthmocap {
namespace {

double distanceByBruteForce(const MaskImage& mask, int u, int v) {
  double best = std::numeric_limits<double>::max();
  for (int y = 0; y < mask.height; ++y) {
    for (int x = 0; x < mask.width; ++x) {
      if (mask.at(x, y) != 0) best = std::min(best, std::hypot(x - u, y - v));
    }
  }
  return best;
}

TEST(Silhouette, FindsANearestPixelAsBruteForceDoes) {
  MaskImage mask(120, 96, 0);
  for (int y = 20; y < 70; ++y) {
    for (int x = 30; x < 44; ++x) mask.at(x, y) = 1;
    for (int x = 70; x < 92; ++x) mask.at(x, y) = 1;
  }
  Silhouette silhouette;
  silhouette.observe(mask);
  ASSERT_FALSE(silhouette.empty());
  Random random(3);
  for (int i = 0; i < 300; ++i) {
    const int u = static_cast<int>(random.below(120));
    const int v = static_cast<int>(random.below(96));
    const Eigen::Vector2i found = silhouette.nearest(u, v);
    EXPECT_NE(mask.at(found.x(), found.y()), 0) << u << " " << v;
    EXPECT_NEAR(std::hypot(found.x() - u, found.y() - v), distanceByBruteForce(mask, u, v), 1.5 * Silhouette::kStep);
  }
}

TEST(Silhouette, IsEmptyWithoutAnActor) {
  Silhouette silhouette;
  EXPECT_TRUE(silhouette.empty());
  silhouette.observe(MaskImage(64, 48, 1));
  EXPECT_FALSE(silhouette.empty());
  silhouette.observe(MaskImage(64, 48, 0));
  EXPECT_TRUE(silhouette.empty());
}

TEST(Silhouette, HoldsForSizesThatAreNoMultipleOfItsGrid) {
  const MaskImage mask(67, 45, 1);
  Silhouette silhouette;
  silhouette.observe(mask);
  const Eigen::Vector2i found = silhouette.nearest(66, 44);
  EXPECT_TRUE(mask.contains(found.x(), found.y()));
}

}  // namespace
}  // namespace depthmocap
