#include "forest/train/joint_hits.h"

#include <gtest/gtest.h>

#include "depthmocap/error.h"
#include "libtracker/recording/track_files.h"
#include "tests/support/made_recording.h"
#include "tests/support/temporary_folder.h"

namespace depthmocap {
namespace {

// Calls every pixel a head.
Forest headForest() {
  Forest forest;
  forest.trees.resize(1);
  forest.trees[0].nodes.resize(1);
  forest.trees[0].leaves.resize(1);
  forest.trees[0].leaves[0][0] = 255;
  return forest;
}

// 20x20 pixels, f = 20 px; people are the left half of the picture, 2 m away. Reference: all joints at one pixel.
class JointHitsTest : public ::testing::Test {
 protected:
  void record(const std::vector<int>& frames) {
    const RecordingInfo info = smallCamera(20, 20);
    RecordingWriter writer(folder_.path() / "rec", info);
    for (const int number : frames) {
      DepthFrame frame = patternFrame(info.camera, number, info.fps);
      for (int y = 0; y < 20; ++y) {
        for (int x = 0; x < 20; ++x) frame.depth.at(x, y) = x < 10 ? 2.0F : 0.0F;
      }
      writer.write(frame);
    }
    std::filesystem::create_directories(recording() / "reference");
  }
  void refer(const std::vector<std::pair<int, int>>& frame_and_x, TrackState state = TrackState::Tracking) {
    JointsWriter writer(recording() / "reference" / "joints.csv");
    for (const auto& [frame, x] : frame_and_x) {
      JointsRow row;
      row.frame = frame;
      row.time_s = frame / 30.0;
      row.state = state;
      row.p_camera.colwise() = smallCamera(20, 20).camera.unproject(x, 10, 2.0);
      writer.write(row);
    }
    writer.finish();
  }
  [[nodiscard]] std::filesystem::path recording() const { return folder_.path() / "rec"; }
  TemporaryFolder folder_;
};

TEST_F(JointHitsTest, AJointIsHitByItsPartsWithinTwoPixels) {
  record({0, 1, 2});
  refer({{0, 5}, {1, 11}, {2, 12}});  // on the person, two pixels beside, three pixels beside
  const JointHits hits = measureJointHits(headForest(), recording(), 1);
  EXPECT_NEAR(hits.shareOf(Joint::Head), 2.0 / 3, 1e-9);
  EXPECT_NEAR(hits.shareOf(Joint::Neck), 2.0 / 3, 1e-9);  // head meets neck
  EXPECT_EQ(hits.shareOf(Joint::LeftShoulder), 0.0);
  EXPECT_EQ(hits.all[static_cast<std::size_t>(Joint::LeftShoulder)], 3);
  EXPECT_EQ(hits.all[static_cast<std::size_t>(Joint::Pelvis)], 0);
  EXPECT_NEAR(hits.meanShare(), 2.0 * 2 / 3 / 14, 1e-9);
}

TEST_F(JointHitsTest, TakesEveryNthFrameAndTheTrackedOnes) {
  record({0, 1, 2, 3});
  refer({{0, 5}, {1, 5}, {2, 5}, {3, 5}});
  EXPECT_EQ(measureJointHits(headForest(), recording(), 2).all[static_cast<std::size_t>(Joint::Head)], 2);
  refer({{0, 5}, {1, 5}}, TrackState::Lost);
  EXPECT_EQ(measureJointHits(headForest(), recording(), 1).all[static_cast<std::size_t>(Joint::Head)], 0);
  EXPECT_THROW(measureJointHits(headForest(), recording(), 0), Error);
}

TEST_F(JointHitsTest, AnEmptyFolderIsAnError) {
  EXPECT_THROW(measureJointHits(headForest(), folder_.path(), 1), Error);
}

}  // namespace
}  // namespace depthmocap
