#include "libtracker/session/look_ahead.h"

#include <array>
#include <vector>

#include <gtest/gtest.h>

#include "depthmocap/world_frame.h"
#include "libtracker/actor/make_actor.h"
#include "libtracker/tracker/alignment.h"

namespace depthmocap {
namespace {

constexpr std::size_t kFrames = 20;
constexpr std::size_t kStep = 10;  // from here on another pose
constexpr double kCalm = 0.2;      // [rad] of the left arm, before and after
constexpr double kRaised = 0.9;
constexpr double kEvidence = 100.0;  // [1/rad^2] of each degree of freedom in each frame

class LookAheadFrames : public testing::Test {
 protected:
  LookAheadFrames() : actor_(averageActor(averageBoneLengths(1.7))), frames_(kFrames) {
    evidence_.A.diagonal().setConstant(kEvidence);
    for (std::size_t i = 0; i < kFrames; ++i) {
      TrackedFrame& frame = frames_[i];
      frame.frame = static_cast<std::int64_t>(i);
      frame.time_s = static_cast<double>(i) / 30.0;
      frame.state = TrackState::Tracking;
      frame.q[kLhumerusRz] = i < kStep ? kCalm : kRaised;
      frame.joints_camera.setConstant(static_cast<double>(i));
      frame.labels.reset(2, 1, static_cast<std::uint8_t>(i));
    }
  }

  // The frames as they leave, with the same numbers and depth as they had.
  std::vector<TrackedFrame> pass(double reach_s) {
    LookAhead waiting(reach_s, 2);
    std::vector<TrackedFrame> left;
    const auto take = [&] {
      while (const LookAhead::Frame* frame = waiting.next()) {
        EXPECT_EQ(frame->index, 100 + left.size());
        EXPECT_EQ(frame->depth.depth.at(0, 0), static_cast<float>(left.size()));
        left.push_back(frame->people.front().tracked);
        EXPECT_EQ(frame->people.back().tracked.q, still_.q) << "the other one stands still";
      }
    };
    DepthFrame depth;
    for (std::size_t i = 0; i < kFrames; ++i) {
      depth.depth.reset(2, 1, static_cast<float>(i));
      still_.time_s = frames_[i].time_s;
      const std::array<LookAhead::Seen, 2> people{{{&frames_[i], &actor_, &evidence_}, {&still_, &actor_, &evidence_}}};
      waiting.add(100 + i, depth, people);
      take();
    }
    waiting.finish();
    take();
    EXPECT_EQ(left.size(), kFrames);
    return left;
  }

  void expectAsTheyCame() {
    const auto left = pass(kLookAhead_s);
    for (std::size_t i = 0; i < kFrames; ++i)
      EXPECT_NEAR(left[i].q[kLhumerusRz], frames_[i].q[kLhumerusRz], 1e-12) << i;
  }

  Actor actor_;
  std::vector<TrackedFrame> frames_;
  NormalEquations evidence_;  // of every frame: all degrees of freedom are seen alike
  TrackedFrame still_;        // somebody who is not there
};

TEST_F(LookAheadFrames, StepOfAnUnbrokenTrackIsSmoothedOnBothSides) {
  const auto left = pass(kLookAhead_s);
  EXPECT_GT(std::abs(left[kStep - 1].q[kLhumerusRz] - kCalm), 0.05);
  EXPECT_GT(std::abs(left[kStep].q[kLhumerusRz] - kRaised), 0.05);
  EXPECT_NEAR(left[1].q[kLhumerusRz], kCalm, 0.05);
  EXPECT_NEAR(left[kFrames - 2].q[kLhumerusRz], kRaised, 0.05);
}

TEST_F(LookAheadFrames, OffFramesLeaveAsTheyCame) {
  const auto left = pass(0);
  for (std::size_t i = 0; i < kFrames; ++i) {
    EXPECT_EQ(left[i].q, frames_[i].q);
    EXPECT_EQ(left[i].joints_camera, frames_[i].joints_camera);
    EXPECT_EQ(left[i].labels.data, frames_[i].labels.data);
  }
}

TEST_F(LookAheadFrames, JointsAndMarkersFollowThePoseAndTheRestStays) {
  const Eigen::Matrix3d R_world_camera =
      Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitX()).toRotationMatrix() * uprightWorldFromCamera();
  for (TrackedFrame& frame : frames_) frame.R_world_camera = R_world_camera;
  const TrackedFrame frame = pass(kLookAhead_s)[kStep];
  ForwardKinematics fk;
  const Eigen::Matrix3d R_camera_world = R_world_camera.transpose();
  EXPECT_LT((frame.joints_camera - R_camera_world * jointPositions(actor_.skeleton, frame.q)).norm(), 1e-12);
  const MarkerSet markers = rotated(R_camera_world, modelMarkers(actor_, frame.q, fk));
  EXPECT_LT((frame.model_markers_camera.position - markers.position).norm(), 1e-12);
  EXPECT_EQ(frame.labels.data, frames_[kStep].labels.data);
  EXPECT_EQ(frame.time_s, frames_[kStep].time_s);
}

TEST_F(LookAheadFrames, PoseFoundAnewIsABorder) {
  frames_[kStep].reinitialised = true;
  expectAsTheyCame();
}

TEST_F(LookAheadFrames, TurnOfTheWorldIsABorder) {
  for (std::size_t i = kStep; i < kFrames; ++i) frames_[i].R_world_camera.setIdentity();
  expectAsTheyCame();
}

TEST_F(LookAheadFrames, CoastingAndLostFramesAreBordersAndStay) {
  for (const TrackState state : {TrackState::Coasting, TrackState::Lost}) {
    frames_[kStep].state = state;
    frames_[kStep].q.setConstant(7);
    expectAsTheyCame();
  }
}

}  // namespace
}  // namespace depthmocap
