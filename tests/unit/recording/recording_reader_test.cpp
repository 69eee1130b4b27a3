#include <gtest/gtest.h>

#include "depthmocap/error.h"
#include "libtracker/recording/recording.h"
#include "tests/support/temporary_folder.h"

namespace depthmocap {
namespace {

std::filesystem::path fixture(const std::string& name) {
  return testData("recordings") / name;
}

TEST(RecordingReader, ReadsHeaderAndFrames) {
  const auto recording = openRecording(fixture("good"));
  const RecordingInfo& info = recording->info();
  EXPECT_EQ(info.camera.width, 6);
  EXPECT_EQ(info.camera.height, 4);
  EXPECT_EQ(info.camera.fx, 5.0);
  EXPECT_EQ(info.camera.fy, 5.5);
  EXPECT_EQ(info.camera.cx, 2.5);
  EXPECT_EQ(info.camera.cy, 1.5);
  EXPECT_FALSE(info.camera.hasDistortion());
  EXPECT_EQ(info.fps, 30.0);
  EXPECT_EQ(info.camera_name, "kinect1");
  EXPECT_EQ(info.note, "a fixture");
  EXPECT_EQ(info.extra_json, R"({"studio":{"room":7}})");
  ASSERT_EQ(recording->frameCount(), 3U);
  DepthFrame frame;
  recording->read(1, frame);
  EXPECT_EQ(frame.frame, 1);
  EXPECT_EQ(frame.time_s, 0.033333);
  EXPECT_EQ(frame.depth.at(0, 0), 0.0F);
  EXPECT_EQ(frame.depth.at(4, 3), static_cast<float>(1034 * 0.002));
}

struct BadRecording {
  const char* name;
  const char* says;  // part of the message
};

void PrintTo(const BadRecording& bad, std::ostream* stream) {
  *stream << bad.name;
}

class RecordingReaderRefuses : public testing::TestWithParam<BadRecording> {};

TEST_P(RecordingReaderRefuses, AndSaysWhy) {
  const std::string message = errorOf([] { openRecording(fixture(GetParam().name)); });
  EXPECT_NE(message.find(GetParam().says), std::string::npos) << message;
  EXPECT_NE(message.find(GetParam().name), std::string::npos) << "the file is not named: " << message;
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

INSTANTIATE_TEST_SUITE_P(
    DamagedRecordings, RecordingReaderRefuses,
    testing::Values(BadRecording{"does_not_exist", "no such recording"}, BadRecording{"empty", "no frame"},
                    BadRecording{"no_json", "not valid JSON"}, BadRecording{"no_object", "JSON object"},
                    BadRecording{"wrong_format", "\"format\" must be"}, BadRecording{"future_version", "version 99"},
                    BadRecording{"no_fps", "\"fps\" is missing"}, BadRecording{"zero_unit", "\"depth_unit_m\""},
                    BadRecording{"no_width", "\"width\" is missing"}, BadRecording{"zero_width", "width and height"},
                    BadRecording{"huge_width", "width and height"},
                    BadRecording{"no_intrinsics", "\"intrinsics\" is missing"},
                    BadRecording{"nan_intrinsics", "not valid JSON"}, BadRecording{"null_intrinsics", "\"cx\""},
                    BadRecording{"zero_focal_length", "\"fy\" must lie in"},
                    BadRecording{"negative_focal_length", "\"fx\" must lie in"},
                    BadRecording{"short_distortion", "\"distortion\""}, BadRecording{"wrong_columns", "column 1"},
                    BadRecording{"times_out_of_order", "line 4: times must grow"},
                    BadRecording{"same_time_twice", "line 3: times must grow"},
                    BadRecording{"short_row", "line 3: has 2 fields"}, BadRecording{"no_number", "line 3: time_s"},
                    BadRecording{"nan_time", "line 2: time_s"}, BadRecording{"path_outside", "not inside"},
                    BadRecording{"path_absolute", "not inside"}, BadRecording{"tum_out_of_order", "times must grow"}),
    [](const auto& test) { return std::string(test.param.name); });

TEST(RecordingReader, SaysOfEachDamagedPictureWhatIsWrongAndReadsTheOthers) {
  const auto recording = openRecording(fixture("damaged_pictures"));
  const std::vector<const char*> says = {"",     "cut short",  "cut short", "damaged", "8 bits",
                                         "grey", "7x4 pixels", "PNG",       "PNG",     "No such file"};
  ASSERT_EQ(recording->frameCount(), says.size());
  DepthFrame frame;
  for (std::size_t i = 1; i < says.size(); ++i) {
    const std::string message = errorOf([&] { recording->read(i, frame); });
    EXPECT_NE(message.find(says[i]), std::string::npos) << i << ": " << message;
    EXPECT_EQ(recording->frameNumber(i), static_cast<std::int64_t>(i));
  }
  recording->read(0, frame);
  EXPECT_EQ(frame.depth.at(1, 0), static_cast<float>(1001 * 0.002));
}

TEST(RecordingReader, UndistortsWithTheRecordingsCoefficients) {
  const TemporaryFolder folder;
  std::filesystem::copy(fixture("good"), folder.path(), std::filesystem::copy_options::recursive);
  std::string header = readBytes(folder / "recording.json");
  header.insert(header.find("\"fx\""), "\"distortion\": [10.0, 0, 0, 0, 0], ");
  writeBytes(folder / "recording.json", header);
  const auto recording = openRecording(folder.path());
  DepthFrame frame;
  recording->read(0, frame);
  EXPECT_EQ(frame.depth.at(2, 1), static_cast<float>(1012 * 0.002)) << "near the centre nothing moves";
  EXPECT_EQ(frame.depth.at(5, 3), 0.0F) << "the corner comes from outside the picture";
}

TEST(RecordingReader, ReadsTumFolders) {
  const auto recording = openRecording(fixture("tum_freiburg1_fixture"));
  EXPECT_EQ(recording->info().camera.fx, 525.0);
  EXPECT_NEAR(recording->info().fps, 30.0, 0.01) << "the gap of three frames does not count";
  ASSERT_EQ(recording->frameCount(), 4U);
  DepthFrame frame;
  recording->read(1, frame);
  EXPECT_EQ(frame.frame, 1);
  EXPECT_EQ(frame.time_s, 100.033333);
  EXPECT_EQ(frame.depth.width, 640);
  EXPECT_EQ(frame.depth.at(5, 5), 2.0F);
  EXPECT_EQ(frame.depth.at(5, 400), 0.0F);
}

TEST(RecordingReader, KnowsTheThirdTumCameraByItsName) {
  const CameraModel camera = openRecording(fixture("tum_freiburg3_fixture"))->info().camera;
  EXPECT_EQ(camera.fx, 535.4);
  EXPECT_EQ(camera.cy, 247.6);
}

TEST(RecordingReader, RefusesOtherThingsByName) {
  const TemporaryFolder folder;
  writeBytes(folder / "session.oni", "");
  EXPECT_NE(errorOf([&] { openRecording(folder / "session.oni"); }).find("no OpenNI recording"), std::string::npos);
  EXPECT_NE(errorOf([&] { openRecording(folder.path()); }).find("neither"), std::string::npos);
  writeBytes(folder / "film.mp4", "");
  EXPECT_NE(errorOf([&] { openRecording(folder / "film.mp4"); }).find("a recording is a folder"), std::string::npos);
}

}  // namespace
}  // namespace depthmocap
