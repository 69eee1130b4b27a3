#include "libtracker/sensor/recorder.h"

#include <nlohmann/json.hpp>

#include <gtest/gtest.h>

#include "tests/support/made_recording.h"
#include "tests/support/temporary_folder.h"

namespace depthmocap {
namespace {

namespace fs = std::filesystem;

SensorFrame sensorFrame(const RecordingInfo& info, int number) {
  SensorFrame frame;
  frame.depth = patternFrame(info.camera, number, info.fps);
  return frame;
}

nlohmann::json recorderNote(const fs::path& folder) {
  return nlohmann::json::parse(readBytes(folder / "recording.json")).at("recorder");
}

class RecorderTest : public testing::Test {
 protected:
  RecordingInfo info_ = smallCamera();
  TemporaryFolder folder_;
};

TEST_F(RecorderTest, WritesEachFrameOfASourceThatWaits) {
  Recorder recorder(folder_ / "rec", info_, true, 4);
  for (int i = 0; i < 50; ++i) EXPECT_TRUE(recorder.push(sensorFrame(info_, i)));
  recorder.finish(0);
  const auto reader = openRecording(folder_ / "rec");
  ASSERT_EQ(reader->frameCount(), 50U);
  DepthFrame frame;
  for (int i = 0; i < 50; ++i) {
    reader->read(static_cast<std::size_t>(i), frame);
    EXPECT_EQ(frame.frame, i);
    EXPECT_EQ(frame.depth.data, patternDepth(info_.camera, i).data);
  }
  EXPECT_EQ(recorderNote(folder_ / "rec"), (nlohmann::json{{"written", 50}, {"dropped", 0}, {"missing", 0}}));
}

// Pictures come faster than any disk takes them.
TEST_F(RecorderTest, NeverWaitsForASlowDiskButCountsWhatItDrops) {
  info_ = smallCamera(640, 480);
  Recorder recorder(folder_ / "rec", info_, false, 3);
  SensorFrame frame = sensorFrame(info_, 0);
  int accepted = 0;
  for (int i = 0; i < 60; ++i) {
    frame.depth.frame = i;
    frame.depth.time_s = i / info_.fps;
    accepted += recorder.push(frame) ? 1 : 0;
  }
  recorder.finish(2);
  const RecorderStatus status = recorder.status();
  EXPECT_GT(status.dropped, 0) << "had it waited, it would have dropped none";
  EXPECT_EQ(status.written, accepted);
  EXPECT_EQ(status.written + status.dropped, 60);
  EXPECT_EQ(recorderNote(folder_ / "rec").at("dropped"), status.dropped);
  EXPECT_EQ(recorderNote(folder_ / "rec").at("missing"), 2);
  const auto reader = openRecording(folder_ / "rec");
  EXPECT_EQ(reader->frameCount(), static_cast<std::size_t>(accepted));
}

TEST_F(RecorderTest, RefusesToOverwrite) {
  makeRecording(folder_ / "rec", info_, 1);
  EXPECT_NE(errorOf([&] { Recorder(folder_ / "rec", info_, false); }).find("not overwritten"), std::string::npos);
}

TEST_F(RecorderTest, AppearsWithTheFirstFrame) {
  Recorder recorder(folder_ / "rec", info_, true);
  EXPECT_FALSE(fs::exists(folder_ / "rec")) << "a recording without a frame could not be opened";
  EXPECT_NE(errorOf([&] { Recorder(folder_ / "rec", info_, true); }).find("rec.partial"), std::string::npos);
  recorder.push(sensorFrame(info_, 0));
  while (recorder.status().written < 1) std::this_thread::yield();
  EXPECT_EQ(openRecording(folder_ / "rec")->frameCount(), 1U);
  EXPECT_FALSE(fs::exists(folder_ / "rec.partial"));
}

TEST_F(RecorderTest, LeavesNothingWithoutAFrame) {
  Recorder(folder_ / "rec/", info_, true).finish(0);
  EXPECT_TRUE(fs::is_empty(folder_.path()));
}

TEST_F(RecorderTest, EndsInGoodOrderWhenWritingFails) {
  Recorder recorder(folder_ / "rec", info_, true, 4);
  for (int i = 0; i < 5; ++i) recorder.push(sensorFrame(info_, i));
  while (recorder.status().written < 5) std::this_thread::yield();
  fs::remove_all(folder_ / "rec/depth");  // as a disk that goes away
  for (int i = 5; i < 15; ++i) recorder.push(sensorFrame(info_, i));
  EXPECT_NE(errorOf([&] { recorder.finish(0); }).find("cannot be written"), std::string::npos);
  EXPECT_FALSE(recorder.status().failure.empty());
  EXPECT_EQ(recorder.status().written, 5);
  EXPECT_EQ(recorder.status().dropped, 10);
  EXPECT_EQ(openRecording(folder_ / "rec")->frameCount(), 5U);
}

}  // namespace
}  // namespace depthmocap
