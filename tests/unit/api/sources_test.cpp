// Recordings and cameras as users of the library see them: public headers only.
#include <gtest/gtest.h>

#include "depthmocap/depthmocap.h"
#include "tests/support/recording_excerpt.h"

namespace depthmocap {
namespace {

constexpr int kFrames = 5;
constexpr std::chrono::milliseconds kWait{5000};

TEST(Recording, GivesFramesInMetres) {
  Recording recording(bundledRecording("walk"));
  EXPECT_GT(recording.frameCount(), 50U);
  EXPECT_EQ(recording.camera().width, 640);
  EXPECT_GT(recording.fps(), 0);
  const DepthFrame frame = recording.read(1);
  EXPECT_EQ(frame.frame, recording.frameNumber(1));
  EXPECT_EQ(frame.time_s, recording.time_s(1));
  ASSERT_EQ(frame.depth.height, recording.camera().height);
  const float farthest = *std::max_element(frame.depth.data.begin(), frame.depth.data.end());
  EXPECT_GT(farthest, 0.5F);
  EXPECT_LT(farthest, 70.0F);
}

TEST(Recording, RefusesAFrameThatIsNotThere) {
  Recording recording(bundledRecording("walk"));
  EXPECT_THROW(static_cast<void>(recording.read(recording.frameCount())), Error);
  EXPECT_THROW(static_cast<void>(recording.time_s(recording.frameCount())), Error);
}

TEST(Recording, NamesTheFolderThatIsMissing) {
  try {
    const Recording recording("no/such/folder");
    FAIL() << "opened";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("no/such/folder"), std::string::npos);
  }
}

TEST(Recording, TakesWhatItsUserKnowsBetter) {
  CameraCorrection correction;
  correction.depth_unit_m = 0.002;
  correction.turn_deg = 90;
  Recording as_it_is(bundledRecording("walk"));
  Recording corrected(bundledRecording("walk"), correction);
  EXPECT_EQ(corrected.camera().width, as_it_is.camera().height);
  EXPECT_EQ(corrected.camera().cy, as_it_is.camera().cx);
  const DepthFrame before = as_it_is.read(0);
  const DepthFrame after = corrected.read(0);
  EXPECT_FLOAT_EQ(after.depth.at(before.depth.height - 1 - 300, 320), 2 * before.depth.at(320, 300));
}

TEST(Recording, RefusesCorrectionsThatAreNotFit) {
  CameraCorrection correction;
  correction.turn_deg = 45;
  EXPECT_THROW(Recording(bundledRecording("walk"), correction), Error);
  correction = {"no/such/camera.json", std::nullopt, 0};
  EXPECT_THROW(Recording(bundledRecording("walk"), correction), Error);
  correction = {{}, -1.0, 0};
  EXPECT_THROW(Recording(bundledRecording("walk"), correction), Error);
}

TEST(Camera, ARecordingBehavesAsOne) {
  const TemporaryFolder folder;
  copyExcerpt("walk", kFrames, folder / "rec");
  CameraOptions options;
  options.speed = 0;
  Camera camera("replay:" + (folder / "rec").string(), options);
  EXPECT_EQ(camera.model().width, 640);
  DepthFrame frame;
  double last_s = -1;
  for (int i = 0; i < kFrames; ++i) {
    ASSERT_EQ(camera.next(frame, kWait), SourceState::Frame);
    EXPECT_EQ(frame.depth.width, 640);
    EXPECT_GT(frame.time_s, last_s);
    last_s = frame.time_s;
  }
  EXPECT_EQ(camera.next(frame, kWait), SourceState::Ended);
  EXPECT_EQ(frame.depth.width, 640) << "only a new frame changes the old one";
}

TEST(Camera, RefusesANameThatIsNoSource) {
  EXPECT_THROW(Camera("webcam"), Error);
}

TEST(Camera, ListsWithoutACamera) {
  EXPECT_NO_THROW(static_cast<void>(Camera::list()));
}

}  // namespace
}  // namespace depthmocap
