#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "libtracker/recording/recording.h"
#include "libtracker/recording/track_files.h"
#include "tests/support/recording_excerpt.h"
#include "tests/support/run_program.h"

namespace depthmocap {
namespace {

constexpr int kFrames = 8;

// Replays recordings that something is wrong with. Those that are damaged here start as good ones.
class ReplayBadInput : public testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path recording() const { return folder_ / "rec"; }
  [[nodiscard]] std::filesystem::path picture(int frame) const { return recording() / "depth" / framePng(frame); }
  [[nodiscard]] ProgramResult replay(const std::filesystem::path& path) const {
    return runProgram("replay " + quoted(path) + " --joints " + quoted(folder_ / "j.csv"));
  }
  [[nodiscard]] std::vector<JointsRow> joints() const { return readJointsFile(folder_ / "j.csv"); }
  void expectFailure(const std::filesystem::path& path, const std::string& reason) const {
    const ProgramResult result = replay(path);
    EXPECT_EQ(result.exit_code, 1) << path;
    EXPECT_EQ(std::count(result.errors.begin(), result.errors.end(), '\n'), 1) << result.errors;
    EXPECT_NE(result.errors.find(path.string()), std::string::npos) << result.errors;
    EXPECT_NE(result.errors.find(reason), std::string::npos) << result.errors;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "j.csv"));
  }
  // One picture in the middle cannot be used: it is named, the tracker gets over it.
  void expectOneFrameWithoutMeasurement(int frame, const std::string& reason) const {
    const ProgramResult result = replay(recording());
    EXPECT_EQ(result.exit_code, 0) << result.errors;
    EXPECT_NE(result.errors.find("warning: " + picture(frame).string()), std::string::npos) << result.errors;
    EXPECT_NE(result.errors.find(reason), std::string::npos) << result.errors;
    const auto rows = joints();
    ASSERT_EQ(rows.size(), static_cast<std::size_t>(kFrames));
    for (int i = 0; i < kFrames; ++i) {
      EXPECT_EQ(rows[static_cast<std::size_t>(i)].frame, i);
      EXPECT_EQ(rows[static_cast<std::size_t>(i)].state == TrackState::Tracking, i != frame) << i;
    }
  }
  TemporaryFolder folder_;
};

TEST_F(ReplayBadInput, MissingFolder) {
  expectFailure(folder_ / "none", "none");
}

TEST_F(ReplayBadInput, HeadersAndIndexThatAreWrong) {
  expectFailure(testData("recordings/empty"), "no frame");
  expectFailure(testData("recordings/nan_intrinsics"), "recording.json");
  expectFailure(testData("recordings/negative_focal_length"), "fx");
  expectFailure(testData("recordings/times_out_of_order"), "times");
  expectFailure(testData("recordings/same_time_twice"), "times");
  expectFailure(testData("recordings/no_json"), "recording.json");
}

TEST_F(ReplayBadInput, PictureCutShort) {
  copyExcerpt("walk", kFrames, recording());
  const std::string bytes = readBytes(picture(4));
  writeBytes(picture(4), bytes.substr(0, bytes.size() / 2));
  expectOneFrameWithoutMeasurement(4, "cut short");
}

TEST_F(ReplayBadInput, PictureOfEightBits) {
  copyExcerpt("walk", kFrames, recording());
  writeBytes(picture(4), readBytes(testData("recordings/damaged_pictures/depth/eight_bits.png")));
  expectOneFrameWithoutMeasurement(4, "8 bits");
}

TEST_F(ReplayBadInput, PictureOfAnotherSize) {
  copyExcerpt("walk", kFrames, recording());
  writeBytes(picture(4), readBytes(bundledRecording("squat") / "depth" / framePng(0)));
  expectOneFrameWithoutMeasurement(4, "320x240 pixels, not 640x480");
}

TEST_F(ReplayBadInput, NoPictureThatCanBeRead) {
  copyExcerpt("walk", 3, recording());
  for (int frame = 0; frame < 3; ++frame) writeBytes(picture(frame), "no picture");
  const ProgramResult result = replay(recording());
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_NE(result.errors.find("no frame of the recording can be read"), std::string::npos) << result.errors;
}

TEST_F(ReplayBadInput, NobodyInThePicture) {
  RecordingInfo info;
  info.camera = {320, 240, 262.5, 262.5, 159.5, 119.5};
  {
    RecordingWriter writer(recording(), info);
    for (int i = 0; i < 4; ++i) {
      // Nothing at all, then a wall.
      writer.write({.frame = i, .time_s = i / 30.0, .depth = DepthImage(320, 240, i < 2 ? 0.0F : 2.5F)});
    }
  }
  const ProgramResult result = replay(recording());
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  const auto rows = joints();
  ASSERT_EQ(rows.size(), 4U);
  for (const JointsRow& row : rows) EXPECT_EQ(row.state, TrackState::Lost);
}

}  // namespace
}  // namespace depthmocap
