#include "libtracker/classify/actor_depth.h"

#include <tuple>

#include <gtest/gtest.h>

#include "libtracker/classify/forest.h"

namespace depthmocap {
namespace {

constexpr int kWidth = 37;  // no multiple of eight
constexpr int kHeight = 5;

TEST(CutOutActor, FindsOnePixelAnywhere) {
  const DepthImage depth(kWidth, kHeight, 2.0F);
  ActorDepth actor;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      MaskImage mask(kWidth, kHeight, 0);
      mask.at(x, y) = 255;
      cutOutActor(depth, mask, actor);
      ASSERT_EQ(std::tuple(actor.left, actor.top, actor.width, actor.height), std::tuple(x, y, 1, 1));
      ASSERT_EQ(actor.probe(1, 1), 2.0F);
      ASSERT_EQ(actor.depth_m.size(), 9U);
    }
  }
}

TEST(CutOutActor, TheBoxHoldsTwoFarPixels) {
  const DepthImage depth(kWidth, kHeight, 2.0F);
  ActorDepth actor;
  for (int left = 0; left < kWidth; ++left) {
    for (int right = left; right < kWidth; ++right) {
      MaskImage mask(kWidth, kHeight, 0);
      mask.at(left, 3) = 1;
      mask.at(right, 1) = 1;
      cutOutActor(depth, mask, actor);
      ASSERT_EQ(std::tuple(actor.left, actor.top, actor.width, actor.height), std::tuple(left, 1, right - left + 1, 3));
    }
  }
}

TEST(CutOutActor, TheRestIsBackground) {
  DepthImage depth(kWidth, kHeight, 2.0F);
  MaskImage mask(kWidth, kHeight, 0);
  for (int x = 10; x < 30; ++x) mask.at(x, 2) = 1;
  mask.at(20, 2) = 0;
  depth.at(25, 2) = 0;  // not measured
  ActorDepth actor;
  cutOutActor(depth, mask, actor);
  for (int x = 10; x < 30; ++x) {
    EXPECT_EQ(actor.probe(x - 9, 1), x == 20 || x == 25 ? kBackgroundDepth_m : 2.0F) << x;
    EXPECT_EQ(actor.probe(x - 9, 0), kBackgroundDepth_m);
  }
}

TEST(CutOutActor, NobodyIsNoBox) {
  ActorDepth actor;
  cutOutActor(DepthImage(kWidth, kHeight, 2.0F), MaskImage(kWidth, kHeight, 0), actor);
  EXPECT_EQ(actor.width, 0);
  EXPECT_EQ(actor.height, 0);
}

}  // namespace
}  // namespace depthmocap
