#include "libtracker/sensor/replay_source.h"

#include <fstream>

#include <gtest/gtest.h>

#include "tests/support/made_recording.h"
#include "tests/support/temporary_folder.h"

namespace depthmocap {
namespace {

constexpr std::chrono::milliseconds kLong{2000};

class ReplaySourceTest : public testing::Test {
 protected:
  ReplaySourceTest() { info_.fps = 50; }
  [[nodiscard]] ReplaySource open(double speed) const { return ReplaySource(openRecording(folder_ / "rec"), speed); }

  RecordingInfo info_ = smallCamera();
  TemporaryFolder folder_;
};

TEST_F(ReplaySourceTest, KeepsThePaceOfTheRecording) {
  makeRecording(folder_ / "rec", info_, 6);
  ReplaySource source = open(1);
  SensorFrame frame;
  const auto start = SensorClock::now();
  for (int i = 0; i < 6; ++i) {
    ASSERT_EQ(source.next(frame, kLong), SourceState::Frame);
    EXPECT_EQ(frame.depth.frame, i);
    EXPECT_LE(frame.taken, SensorClock::now());
  }
  EXPECT_GE(SensorClock::now() - start, std::chrono::milliseconds(100));  // five steps of 20 ms
  EXPECT_EQ(source.next(frame, kLong), SourceState::Ended);
}

TEST_F(ReplaySourceTest, SaysThatAFrameIsNotDueYet) {
  makeRecording(folder_ / "rec", info_, {0, 100});
  ReplaySource source = open(1);
  SensorFrame frame;
  ASSERT_EQ(source.next(frame, kLong), SourceState::Frame);
  EXPECT_EQ(source.next(frame, std::chrono::milliseconds(5)), SourceState::Waiting);
  EXPECT_EQ(frame.depth.frame, 0) << "the frame is changed with a new one only";
}

TEST_F(ReplaySourceTest, WithoutPaceIsAsFastAsItIsAsked) {
  makeRecording(folder_ / "rec", info_, {5, 1000000});
  ReplaySource source = open(0);
  EXPECT_TRUE(source.waitsForReader());
  SensorFrame frame;
  ASSERT_EQ(source.next(frame, kLong), SourceState::Frame);
  EXPECT_EQ(frame.depth.frame, 0) << "numbers count from the first frame";
  EXPECT_EQ(frame.depth.time_s, 0);
  ASSERT_EQ(source.next(frame, kLong), SourceState::Frame);
  EXPECT_EQ(frame.depth.frame, 999995);
}

TEST_F(ReplaySourceTest, GoesOnAfterADamagedPicture) {
  makeRecording(folder_ / "rec", info_, 3);
  std::ofstream(folder_ / "rec/depth/000001.png") << "no picture";
  ReplaySource source = open(0);
  SensorFrame frame;
  EXPECT_EQ(source.next(frame, kLong), SourceState::Frame);
  EXPECT_EQ(source.next(frame, kLong), SourceState::Damaged);
  EXPECT_NE(source.problem().find("000001.png"), std::string::npos);
  EXPECT_EQ(source.next(frame, kLong), SourceState::Frame);
  EXPECT_EQ(frame.depth.frame, 2);
  EXPECT_EQ(frame.depth.depth.data, patternDepth(info_.camera, 2).data);
}

TEST_F(ReplaySourceTest, KeepsThePaceWhenTheFirstPictureIsDamaged) {
  makeRecording(folder_ / "rec", info_, 3);
  std::ofstream(folder_ / "rec/depth/000000.png") << "no picture";
  ReplaySource source = open(1);
  SensorFrame frame;
  EXPECT_EQ(source.next(frame, kLong), SourceState::Damaged);
  const auto start = SensorClock::now();
  EXPECT_EQ(source.next(frame, kLong), SourceState::Frame);
  EXPECT_EQ(source.next(frame, kLong), SourceState::Frame);
  EXPECT_GE(SensorClock::now() - start, std::chrono::milliseconds(15));
  EXPECT_LE(SensorClock::now() - start, std::chrono::milliseconds(1000));
}

}  // namespace
}  // namespace depthmocap
