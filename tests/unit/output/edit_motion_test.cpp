#include "libtracker/output/edit_motion.h"

#include <cmath>

#include <gtest/gtest.h>

#include "libtracker/skeleton/forward_kinematics.h"

namespace depthmocap {
namespace {

// Somebody who walks along x and turns, with arms and knees that move.
MotionTrack walk(int frames) {
  MotionTrack track;
  for (int i = 0; i < frames; ++i) {
    MotionTrack::Frame frame;
    frame.time_s = 2.0 + i / 30.0;
    frame.q[kRootTx] = 0.04 * i;
    frame.q[kRootTy] = 0.9 + 0.02 * std::sin(0.4 * i);
    frame.q[kRootRy] = 0.05 * i;
    frame.q[kLtibiaRx] = 0.5 + 0.4 * std::sin(0.3 * i);
    frame.q[kRhumerusRz] = 1.0 + 0.3 * std::cos(0.3 * i);
    frame.q[kRhumerusRx] = 0.2 * std::sin(0.5 * i);
    track.frames.push_back(frame);
  }
  return track;
}

TEST(EditMotion, AnotherRateKeepsPlacesAndLength) {
  const MotionTrack track = walk(31);
  const MotionTrack doubled = resampled(track, 60.0);
  ASSERT_EQ(doubled.frames.size(), 61U);
  EXPECT_NEAR(doubled.frames.back().time_s, track.frames.back().time_s, 1e-9);
  for (std::size_t i = 0; i < track.frames.size(); ++i) {
    EXPECT_LT((doubled.frames[2 * i].q - track.frames[i].q).cwiseAbs().maxCoeff(), 1e-7);
  }
  EXPECT_NEAR(doubled.frames[1].q[kRootTx], 0.02, 1e-9);
  EXPECT_NEAR(doubled.frames[1].q[kLtibiaRx], 0.5 * (track.frames[0].q[kLtibiaRx] + track.frames[1].q[kLtibiaRx]),
              1e-9);
  EXPECT_EQ(resampled(track, 10.0).frames.size(), 11U);
}

TEST(EditMotion, FullTurnsAreNotPassedTheLongWay) {
  MotionTrack track = walk(2);
  track.frames[0].q[kRootRy] = 3.1;
  track.frames[1].q[kRootRy] = -3.1;
  const double middle = resampled(track, 60.0).frames[1].q[kRootRy];
  EXPECT_NEAR(std::cos(middle), -1.0, 1e-9);
}

TEST(EditMotion, InPlaceKeepsHeightAndTurns) {
  MotionTrack track = walk(20);
  const MotionTrack before = track;
  keepInPlace(track);
  for (std::size_t i = 0; i < track.frames.size(); ++i) {
    EXPECT_EQ(track.frames[i].q[kRootTx], 0.0);
    EXPECT_EQ(track.frames[i].q[kRootTy], before.frames[i].q[kRootTy]);
    EXPECT_EQ(track.frames[i].q[kRootRy], before.frames[i].q[kRootRy]);
  }
}

TEST(EditMotion, ALoopEndsInThePoseInWhichItBegins) {
  MotionTrack track = walk(60);
  const MotionTrack before = track;
  closeLoop(track, false);
  const Pose& first = track.frames.front().q;
  const Pose& last = track.frames.back().q;
  EXPECT_LT((first.tail<kDofCount - kFirstBodyDof>() - last.tail<kDofCount - kFirstBodyDof>()).cwiseAbs().maxCoeff(),
            1e-9);
  EXPECT_NEAR(last[kRootTy], first[kRootTy], 1e-9);
  EXPECT_NEAR(last[kRootTx], before.frames.back().q[kRootTx], 1e-9);  // walks on
  EXPECT_NEAR(last[kRootRy], before.frames.back().q[kRootRy], 1e-9);
  EXPECT_LT((track.frames[40].q - before.frames[40].q).norm(), 1e-12);  // more than half a second before the end
  for (std::size_t i = 1; i < track.frames.size(); ++i) {
    EXPECT_LT(std::abs(track.frames[i].q[kLtibiaRx] - track.frames[i - 1].q[kLtibiaRx]), 0.25) << i;
  }
}

TEST(EditMotion, ALoopInPlaceComesBack) {
  MotionTrack track = walk(60);
  closeLoop(track, true);
  EXPECT_LT((track.frames.front().q - track.frames.back().q).cwiseAbs().maxCoeff(), 1e-9);
}

}  // namespace
}  // namespace depthmocap
