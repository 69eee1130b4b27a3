#include "apps/track/seen_depth.h"

#include <gtest/gtest.h>

namespace depthmocap {
namespace {

std::optional<int> noTurn() {
  return std::nullopt;
}

std::string explanationOf(float depth_m, double measured_share = 1, const TurnSearch& turn = noTurn) {
  DepthFrame frame;
  frame.depth.reset(320, 240, depth_m);
  for (int y = 0; y < 240; ++y) {
    for (int x = 0; x < 320; ++x) {
      if (y >= 240 * measured_share) frame.depth.at(x, y) = 0;
    }
  }
  const TrackedFrame tracked;
  const TrackedFrame* nobody = &tracked;
  SeenDepth seen;
  seen.onFrame({0, frame, tracked, 30.0, {&nobody, 1}});
  return seen.explanation(turn);
}

TEST(SeenDepth, SaysWhatWasSeenAndTheLikelyCause) {
  EXPECT_NE(explanationOf(3.0F).find("depth from 3"), std::string::npos) << explanationOf(3.0F);
  EXPECT_NE(explanationOf(3.0F, 0.5).find("50 %"), std::string::npos) << explanationOf(3.0F, 0.5);
  EXPECT_NE(explanationOf(3.0F).find("nobody"), std::string::npos);
  EXPECT_NE(explanationOf(3.0F, 1, [] { return 270; }).find("--turn 270"), std::string::npos);
  EXPECT_NE(explanationOf(0.003F).find("too small"), std::string::npos);
  EXPECT_NE(explanationOf(40.0F).find("too large"), std::string::npos);
  EXPECT_NE(explanationOf(0.3F).find("too near"), std::string::npos);
  EXPECT_NE(explanationOf(0.0F).find("covered"), std::string::npos);
}

TEST(SeenDepth, IsOnlyNeededWhereHardlyAnythingWasTracked) {
  const SeenDepth nothing;
  EXPECT_EQ(trackedText(0, 0, nothing, noTurn), "tracked 0 of 0 frames");
  EXPECT_EQ(trackedText(90, 100, nothing, noTurn), "tracked 90 of 100 frames");
  EXPECT_EQ(trackedText(90, 100, nothing, [] { return 90; }), "tracked 90 of 100 frames");
  EXPECT_EQ(trackedText(30, 100, nothing, noTurn), "tracked 30 of 100 frames");
  EXPECT_NE(trackedText(30, 100, nothing, [] { return 180; }).find("--turn 180"), std::string::npos);
}

// Frames of somebody whose head points this way in the picture.
std::optional<int> turnOf(const Eigen::Vector3d& head, bool floor = false) {
  DepthFrame frame;
  frame.depth.reset(320, 240, 3.0F);
  TrackedFrame tracked;
  tracked.state = TrackState::Tracking;
  tracked.joints_camera.setZero();
  tracked.joints_camera.col(static_cast<int>(Joint::Neck)) = head;
  if (floor) tracked.floor_world = Eigen::Vector4d(0, 1, 0, 0);
  const TrackedFrame* somebody = &tracked;
  SeenDepth seen;
  for (int i = 0; i < 3; ++i) seen.onFrame({0, frame, tracked, 30.0, {&somebody, 1}});
  return seen.turnIfUpright();
}

TEST(SeenDepth, KnowsTheTurnThatBringsTheHeadUp) {
  EXPECT_EQ(turnOf({0.1, -0.5, 0.2}), std::nullopt);
  EXPECT_EQ(turnOf({-0.5, 0.1, 0}), 90);
  EXPECT_EQ(turnOf({0, 0.5, 0}), 180);
  EXPECT_EQ(turnOf({0.5, 0, 0}), 270);
  EXPECT_EQ(turnOf({0.5, 0, 0}, true), std::nullopt) << "the floor says that somebody lies";
}

}  // namespace
}  // namespace depthmocap
