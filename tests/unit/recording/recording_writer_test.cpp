#include <limits>

#include <gtest/gtest.h>

#include "depthmocap/error.h"
#include "libtracker/recording/recording.h"
#include "tests/support/temporary_folder.h"

namespace depthmocap {
namespace {

namespace fs = std::filesystem;

RecordingInfo smallInfo() {
  RecordingInfo info;
  info.camera.width = 4;
  info.camera.height = 2;
  info.depth_unit_m = 0.001;
  info.extra_json = R"({"studio": 7, "intrinsics": {"serial": "A1"}})";
  return info;
}

DepthFrame smallFrame(std::int64_t number, double time_s) {
  return {number, time_s, DepthImage(4, 2, 1.5F)};
}

TEST(RecordingWriter, GivesBackEveryStepBitForBit) {
  const TemporaryFolder folder;
  RecordingInfo info;
  info.camera.width = 256;
  info.camera.height = 256;
  info.depth_unit_m = 0.004;
  DepthFrame frame{0, 0.0, DepthImage(256, 256)};
  for (std::size_t step = 0; step < frame.depth.data.size(); ++step) {
    frame.depth.data[step] = static_cast<float>(static_cast<double>(step) * info.depth_unit_m);
  }
  RecordingWriter(folder / "rec", info).write(frame);
  DepthFrame read;
  openRecording(folder / "rec")->read(0, read);
  EXPECT_EQ(read.depth.data, frame.depth.data);
}

TEST(RecordingWriter, KeepsHeaderTimesAndUnknownKeys) {
  const TemporaryFolder folder;
  RecordingInfo info = smallInfo();
  info.camera.cx = 1.25;
  info.camera_name = "kinect2";
  info.note = "no UTF-8: \xff";
  RecordingWriter writer(folder / "rec", info);
  writer.write(smallFrame(3, 0.1));
  writer.write(smallFrame(7, 0.2));
  const auto recording = openRecording(folder / "rec");
  EXPECT_EQ(recording->info().camera.cx, 1.25);
  EXPECT_EQ(recording->info().camera_name, "kinect2");
  EXPECT_EQ(recording->info().extra_json, R"({"intrinsics":{"serial":"A1"},"studio":7})");
  ASSERT_EQ(recording->frameCount(), 2U) << "readable while the writer is still open";
  EXPECT_EQ(recording->frameNumber(1), 7);
  EXPECT_EQ(recording->time(1), 0.2);
}

TEST(RecordingWriter, WritesNoDistortionBecauseFramesAreUndistorted) {
  const TemporaryFolder folder;
  RecordingInfo info = smallInfo();
  info.camera.distortion = {0.1, 0, 0, 0, 0};
  RecordingWriter(folder / "rec", info).write(smallFrame(0, 0));
  EXPECT_FALSE(openRecording(folder / "rec")->info().camera.hasDistortion());
}

TEST(RecordingWriter, StoresNoMeasurementForWhatDoesNotFit) {
  const TemporaryFolder folder;
  DepthFrame frame = smallFrame(0, 0);
  frame.depth.data = {-1.0F, 0.0004F, 65.535F, 65.536F, std::numeric_limits<float>::quiet_NaN(), 1e30F, 0.0006F, 2.0F};
  RecordingWriter(folder / "rec", smallInfo()).write(frame);
  DepthFrame read;
  openRecording(folder / "rec")->read(0, read);
  const std::vector<float> expected = {0, 0, 65.535F, 0, 0, 0, 0.001F, 2.0F};
  EXPECT_EQ(read.depth.data, expected);
}

TEST(RecordingWriter, RefusesToOverwrite) {
  const TemporaryFolder folder;
  writeBytes(folder / "diary.txt", "mine");
  const std::string message = errorOf([&] { RecordingWriter writer(folder.path(), smallInfo()); });
  EXPECT_NE(message.find("not overwritten"), std::string::npos) << message;
  EXPECT_THROW(RecordingWriter(folder / "diary.txt", smallInfo()), Error);
}

TEST(RecordingWriter, RefusesACameraThatCannotBeRead) {
  const TemporaryFolder folder;
  RecordingInfo info = smallInfo();
  info.camera.fx = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(RecordingWriter(folder / "rec", info), Error);
}

TEST(RecordingWriter, RefusesFramesThatDoNotFollow) {
  const TemporaryFolder folder;
  RecordingWriter writer(folder / "rec", smallInfo());
  writer.write(smallFrame(5, 1.0));
  EXPECT_THROW(writer.write(smallFrame(5, 1.1)), Error);
  EXPECT_THROW(writer.write(smallFrame(6, 1.0)), Error);
  EXPECT_THROW(writer.write(smallFrame(6, 1.0000001)), Error) << "the same time as far as frames.csv can show";
  writer.write(smallFrame(6, 1.1));
  EXPECT_EQ(openRecording(folder / "rec")->frameCount(), 2U);
}

TEST(RecordingWriter, AppearsWhenFinished) {
  const TemporaryFolder folder;
  {
    RecordingWriter writer(folder / "rec", smallInfo(), RecordingWriter::Appears::WhenFinished);
    writer.write(smallFrame(0, 0));
    EXPECT_EQ(writer.folder(), folder / "rec.partial");
    EXPECT_FALSE(fs::exists(folder / "rec"));
  }
  EXPECT_TRUE(fs::is_empty(folder.path())) << "what is not finished is removed";
  RecordingWriter writer(folder / "rec", smallInfo(), RecordingWriter::Appears::WhenFinished);
  writer.write(smallFrame(0, 0));
  writer.finish();
  EXPECT_EQ(openRecording(folder / "rec")->frameCount(), 1U);
  EXPECT_FALSE(fs::exists(folder / "rec.partial"));
}

TEST(RecordingWriter, TakesTheNameThatAKilledWriterLeft) {
  const TemporaryFolder folder;
  fs::create_directories(folder / "rec.partial/depth");
  writeBytes(folder / "rec.partial/frames.csv", "frame,time_s,file\n");
  RecordingWriter(folder / "rec", smallInfo()).write(smallFrame(0, 0));
  EXPECT_EQ(openRecording(folder / "rec")->frameCount(), 1U);
}

TEST(RecordingWriter, LeavesAFolderOfOtherThings) {
  const TemporaryFolder folder;
  fs::create_directories(folder / "rec.partial");
  writeBytes(folder / "rec.partial/diary.txt", "mine");
  EXPECT_NE(errorOf([&] { RecordingWriter(folder / "rec", smallInfo()); }).find("not overwritten"), std::string::npos);
  EXPECT_EQ(readBytes(folder / "rec.partial/diary.txt"), "mine");
}

TEST(RecordingWriter, KnowsOneThatIsBeingWritten) {
  const TemporaryFolder folder;
  RecordingWriter writer(folder / "rec", smallInfo());
  const auto other = [&] { return errorOf([&] { RecordingWriter(folder / "rec", smallInfo()); }); };
  EXPECT_NE(other().find("is being written by another program"), std::string::npos);
  writer.write(smallFrame(0, 0));
  EXPECT_NE(other().find("is being written by another program"), std::string::npos);
  EXPECT_EQ(openRecording(folder / "rec")->frameCount(), 1U);
}

}  // namespace
}  // namespace depthmocap
