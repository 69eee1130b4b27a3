#include "libtracker/segment/components.h"

#include <gtest/gtest.h>

namespace depthmocap {
namespace {

// A cloud of 20 x 10 cells, 2 cm apart, all at 2 m.
CoarseCloud flatCloud() {
  CoarseCloud cloud;
  cloud.width = 20;
  cloud.height = 10;
  cloud.stride = 4;
  cloud.pixel_angle = 0.01;
  for (int y = 0; y < cloud.height; ++y) {
    for (int x = 0; x < cloud.width; ++x)
      cloud.points.emplace_back(0.02F * static_cast<float>(x), 0.02F * static_cast<float>(y), 2.0F);
  }
  cloud.valid_count = 200;
  return cloud;
}

ComponentFinder findAll(const CoarseCloud& cloud) {
  ComponentFinder finder;
  finder.find(cloud, std::vector<std::uint8_t>(cloud.points.size(), 1), 0.1, {0, -1, 0});
  return finder;
}

TEST(Components, OneSurfaceIsOneComponentWithItsMeasures) {
  const ComponentFinder found = findAll(flatCloud());
  ASSERT_EQ(found.components().size(), 1U);
  const Component& c = found.components()[0];
  EXPECT_EQ(c.cells, 200);
  EXPECT_NEAR(c.area_m2, 200 * 0.0004F, 1e-6F);
  EXPECT_NEAR(c.height(), 0.18F, 1e-6F);
  EXPECT_NEAR(c.widthX(), 0.38F, 1e-6F);
  EXPECT_NEAR(c.bottom_m, -0.18F, 1e-6F);  // y points down
  EXPECT_LT(c.thickness_m, 0.005F);
  EXPECT_TRUE(c.touches_border && c.touches_side);
  EXPECT_TRUE(c.touches_border);
}

TEST(Components, DepthStepSeparates) {
  CoarseCloud cloud = flatCloud();
  for (int y = 0; y < 10; ++y) {
    for (int x = 10; x < 20; ++x) cloud.points[cloud.index(x, y)].z() = 2.15F;
  }
  const ComponentFinder found = findAll(cloud);
  ASSERT_EQ(found.components().size(), 2U);
  EXPECT_EQ(found.components()[0].cells, 100);
  EXPECT_EQ(found.labels()[cloud.index(9, 5)], 0);
  EXPECT_EQ(found.labels()[cloud.index(10, 5)], 1);
}

TEST(Components, OneMissingColumnIsBridgedTwoAreNot) {
  CoarseCloud cloud = flatCloud();
  for (int y = 0; y < 10; ++y) cloud.points[cloud.index(10, y)].setZero();
  EXPECT_EQ(findAll(cloud).components().size(), 1U);
  for (int y = 0; y < 10; ++y) cloud.points[cloud.index(11, y)].setZero();
  EXPECT_EQ(findAll(cloud).components().size(), 2U);
}

TEST(Components, GapGrowsWithDepthAsTheDepthStepsDo) {
  CoarseCloud cloud = flatCloud();
  for (int y = 0; y < 10; ++y) {
    for (int x = 0; x < 20; ++x) cloud.points[cloud.index(x, y)].z() = x < 10 ? 6.0F : 6.15F;
  }
  EXPECT_EQ(findAll(cloud).components().size(), 1U);
}

TEST(Components, CellsThatAreNotKeptTakeNoPart) {
  const CoarseCloud cloud = flatCloud();
  std::vector<std::uint8_t> keep(cloud.points.size(), 0);
  keep[cloud.index(3, 3)] = 1;
  ComponentFinder finder;
  finder.find(cloud, keep, 0.1, {0, -1, 0});
  ASSERT_EQ(finder.components().size(), 1U);
  EXPECT_EQ(finder.components()[0].cells, 1);
  EXPECT_EQ(finder.labels()[0], kNoComponent);
}

}  // namespace
}  // namespace depthmocap
