#include "libtracker/choreography/gait.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace depthmocap {
namespace {

TEST(Gait, FollowsThePathAtItsSpeed) {
  const BodyFrames frames = walkAlong(straightPath(1.2), 3.0, GaitStyle{}, 0.0);
  ASSERT_EQ(frames.size(), 91U);
  EXPECT_NEAR(frames.back().pelvis.z, 3.6, 1e-6);
  EXPECT_LT(std::abs(frames.back().pelvis.x), 0.05);
}

TEST(Gait, AFootStandsStillInStance) {
  const BodyFrames frames = walkAlong(straightPath(1.2), 3.0, GaitStyle{}, 0.0);
  int standing = 0;
  for (std::size_t t = 1; t < frames.size(); ++t) {
    standing += frames[t].right_foot.z == frames[t - 1].right_foot.z ? 1 : 0;
    // Walking: one foot is always on the ground.
    EXPECT_EQ(std::min(frames[t].left_foot.lift, frames[t].right_foot.lift), 0.0) << t;
  }
  EXPECT_NEAR(standing / 90.0, GaitStyle{}.duty, 0.06);
}

TEST(Gait, RunningHasAFlightPhase) {
  GaitStyle style;
  style.duty = 0.35;
  style.running = true;
  double flight = 0;
  for (const BodyFrame& frame : walkAlong(straightPath(2.5), 3.0, style, 0.0)) {
    flight = std::max(flight, std::min(frame.left_foot.lift, frame.right_foot.lift));
  }
  EXPECT_GT(flight, 0.001);
}

TEST(Gait, ArmsSwingAgainstTheLegs) {
  // Right foot before the left one: left wrist before the right one.
  double product = 0;
  for (const BodyFrame& frame : walkAlong(straightPath(1.2), 3.0, GaitStyle{}, 0.0)) {
    // The left arm's swing_y < 0 is forward.
    product += (frame.right_foot.z - frame.left_foot.z) * (frame.right_arm.swing_y - frame.left_arm.swing_y);
  }
  EXPECT_GT(product, 0);
}

TEST(Gait, RestsWhereThePathRests) {
  const auto path = [](double t) { return PathPoint{0, std::min(t, 1.0), 0}; };
  const BodyFrames frames = walkAlong(path, 5.0, GaitStyle{}, 0.3);
  for (std::size_t t = 110; t < frames.size(); ++t) {
    EXPECT_NEAR(frames[t].left_foot.z, frames[110].left_foot.z, 1e-9);
    EXPECT_LT(frames[t].left_foot.lift, 1e-9);
  }
}

TEST(Gait, ArcTurnsTheBodyWithTheVelocity) {
  const WalkPath path = straightPath(1.0, 0.0, 0.5);
  const PathPoint a = path(1.0);
  const PathPoint b = path(1.001);
  EXPECT_NEAR(std::atan2(b.x - a.x, b.z - a.z), a.heading, 1e-3);
  EXPECT_NEAR(std::hypot(b.x - a.x, b.z - a.z), 0.001, 1e-6);
}

TEST(Gait, StairsRaiseFeetAndPelvis) {
  const auto ground = [](double, double z) { return z > 0.5 ? 0.3 : 0.0; };
  const BodyFrames frames = walkAlong(straightPath(0.8), 3.0, GaitStyle{}, 0.0, ground);
  EXPECT_EQ(frames.front().left_foot.ground, 0.0);
  EXPECT_EQ(frames.back().left_foot.ground, 0.3);
  EXPECT_NEAR(frames.back().pelvis.y - frames.front().pelvis.y, 0.3, 0.03);
}

}  // namespace
}  // namespace depthmocap
