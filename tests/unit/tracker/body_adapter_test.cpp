#include "libtracker/tracker/body_adapter.h"

#include <gtest/gtest.h>

#include "libtracker/actor/make_actor.h"

namespace depthmocap {
namespace {

constexpr double kFrame_s = 1.0 / 30.0;

double statureIn(const BodyAdapter& size) {
  return statureOf(size.actor().skeleton.lengths);
}

BodyAdapter uncalibrated(double stature_m, double adapt_s) {
  return {averageActor(averageBoneLengths(stature_m)), false, adapt_s, 0};
}

TEST(BodyAdapter, ConvergesToTheActorFromNoisyFramesAndThenStays) {
  BodyAdapter size = uncalibrated(1.75, 3.0);
  constexpr double kTruth_m = 1.60;
  for (int frame = 0; size.fitsSize(); ++frame) {
    ASSERT_LT(frame, 100);
    const double noise = frame % 2 == 0 ? 1.03 : 1 / 1.03;
    size.observeSize(kTruth_m / statureIn(size) * noise, kFrame_s);
  }
  EXPECT_NEAR(statureIn(size), kTruth_m, 0.005);
  const double fixed_m = statureIn(size);
  size.observeSize(1.2, kFrame_s);
  EXPECT_EQ(statureIn(size), fixed_m);
}

TEST(BodyAdapter, RescalesMarkersAndRadiiWithTheSkeleton) {
  BodyAdapter size = uncalibrated(1.6, 1.0);
  const Actor before = size.actor();
  size.rescale(1.1);
  EXPECT_NEAR(statureIn(size), 1.76, 1e-9);
  EXPECT_NEAR(size.actor().skeleton.lengths.upper_leg, 1.1 * before.skeleton.lengths.upper_leg, 1e-9);
  EXPECT_NEAR(size.actor().radii_m[0], 1.1 * before.radii_m[0], 1e-9);
}

TEST(BodyAdapter, BelievesNoSizeThatNobodyHas) {
  BodyAdapter size = uncalibrated(1.7, 1.0);
  size.rescale(10);
  EXPECT_NEAR(statureIn(size), 2.2, 1e-9);
  size.rescale(0.01);
  EXPECT_NEAR(statureIn(size), 1.0, 1e-9);
}

TEST(BodyAdapter, OneWildFrameMovesTheSizeByAQuarterAtMost) {
  BodyAdapter size = uncalibrated(1.6, 1.0);
  size.observeSize(50, kFrame_s);
  EXPECT_NEAR(statureIn(size), 1.6 * 1.25, 1e-9);
}

TEST(BodyAdapter, FramesThatShowTooLittleDoNotSettleTheSize) {
  BodyAdapter size = uncalibrated(1.6, 1.0);
  for (int frame = 0; frame < 100; ++frame) size.observeSize(1.0, 0.0);
  EXPECT_TRUE(size.fitsSize());
}

TEST(BodyAdapter, LeavesAMeasuredActorAlone) {
  BodyAdapter size(averageActor(averageBoneLengths(1.9)), true, 3.0, 10.0);
  EXPECT_FALSE(size.fitsSize());
  size.observeSize(0.9, kFrame_s);
  size.observeShape({}, kFrame_s);
  EXPECT_NEAR(statureIn(size), 1.9, 1e-9);
}

TEST(BodyAdapter, WearsTheShapeThatFramesTellOfAndFixesIt) {
  BodyAdapter body(averageActor(1.75), false, 0, 1.0);
  ShapeEvidence frame;
  frame.A.diagonal().setConstant(1e6);
  ShapeVector truth = ShapeFit::typical(1.75);
  truth[kBoneLengthCount + static_cast<int>(Girth::UpperArm)] *= 1.2;
  truth[2] *= 0.95;
  frame.b = frame.A * truth;
  for (int i = 0; body.fitsShape(); ++i) {
    ASSERT_LT(i, 40);
    body.observeShape(frame, kFrame_s);
  }
  EXPECT_LT((body.shape() - truth).cwiseAbs().maxCoeff(), 1e-3);
  EXPECT_NEAR(body.actor().skeleton.lengths.upper_leg, truth[2], 1e-3);
  EXPECT_NEAR(body.actor().surface->stature_m, body.actor().stature_m(), 1e-9);
}

}  // namespace
}  // namespace depthmocap
