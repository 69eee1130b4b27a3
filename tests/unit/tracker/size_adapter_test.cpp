#include "libtracker/tracker/size_adapter.h"

#include <gtest/gtest.h>

#include "libtracker/actor/make_actor.h"

namespace depthmocap {
namespace {

constexpr double kFrame_s = 1.0 / 30.0;

double statureIn(const SizeAdapter& size) {
  return statureOf(size.actor().skeleton.lengths);
}

SizeAdapter uncalibrated(double stature_m, double adapt_s) {
  return {averageActor(averageBoneLengths(stature_m)), false, adapt_s};
}

TEST(SizeAdapter, ConvergesToTheActorFromNoisyFramesAndThenStays) {
  SizeAdapter size = uncalibrated(1.75, 3.0);
  constexpr double kTruth_m = 1.60;
  for (int frame = 0; size.adapting(); ++frame) {
    ASSERT_LT(frame, 100);
    const double noise = frame % 2 == 0 ? 1.03 : 1 / 1.03;
    size.observe(kTruth_m / statureIn(size) * noise, kFrame_s);
  }
  EXPECT_NEAR(statureIn(size), kTruth_m, 0.005);
  const double fixed_m = statureIn(size);
  size.observe(1.2, kFrame_s);
  EXPECT_EQ(statureIn(size), fixed_m);
}

TEST(SizeAdapter, RescalesMarkersAndRadiiWithTheSkeleton) {
  SizeAdapter size = uncalibrated(1.6, 1.0);
  const Actor before = size.actor();
  size.rescale(1.1);
  EXPECT_NEAR(statureIn(size), 1.76, 1e-9);
  EXPECT_NEAR(size.actor().skeleton.lengths.upper_leg, 1.1 * before.skeleton.lengths.upper_leg, 1e-9);
  EXPECT_NEAR(size.actor().radii_m[0], 1.1 * before.radii_m[0], 1e-9);
}

TEST(SizeAdapter, BelievesNoSizeThatNobodyHas) {
  SizeAdapter size = uncalibrated(1.7, 1.0);
  size.rescale(10);
  EXPECT_NEAR(statureIn(size), 2.2, 1e-9);
  size.rescale(0.01);
  EXPECT_NEAR(statureIn(size), 1.0, 1e-9);
}

TEST(SizeAdapter, OneWildFrameMovesTheSizeByAQuarterAtMost) {
  SizeAdapter size = uncalibrated(1.6, 1.0);
  size.observe(50, kFrame_s);
  EXPECT_NEAR(statureIn(size), 1.6 * 1.25, 1e-9);
}

TEST(SizeAdapter, FramesThatShowTooLittleDoNotSettleTheSize) {
  SizeAdapter size = uncalibrated(1.6, 1.0);
  for (int frame = 0; frame < 100; ++frame) size.observe(1.0, 0.0);
  EXPECT_TRUE(size.adapting());
}

TEST(SizeAdapter, LeavesAActorAlone) {
  SizeAdapter size(averageActor(averageBoneLengths(1.9)), true, 3.0);
  EXPECT_FALSE(size.adapting());
  size.observe(0.9, kFrame_s);
  EXPECT_NEAR(statureIn(size), 1.9, 1e-9);
}

}  // namespace
}  // namespace depthmocap
