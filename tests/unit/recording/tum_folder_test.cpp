#include "libtracker/recording/tum_folder.h"

#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "libtracker/recording/png_file.h"
#include "libtracker/recording/usual_camera.h"
#include "tests/support/temporary_folder.h"

namespace depthmocap {
namespace {

constexpr int kPictures = 3;

// A folder as cameras and converters write it: pictures of one depth, and a list.
class TumFolder : public testing::Test {
 protected:
  TumFolder() {
    std::filesystem::create_directory(folder_ / "depth");
    std::filesystem::create_directory(folder_ / "rgb");
    writePictures(640, 480, 10000);
  }
  void writePictures(int width, int height, std::uint16_t steps) const {
    for (int i = 0; i < kPictures; ++i) {
      writePng16(folder_ / fmt::format("depth/{}.png", i), Image<std::uint16_t>(width, height, steps));
      writePng8(folder_ / fmt::format("rgb/{}.png", i), Image<std::uint8_t>(width, height, 1));
    }
  }
  void list(const std::string& text, const char* name = "depth.txt") const { writeBytes(folder_ / name, text); }
  void usualList() const { list("10.0 depth/0.png\n10.04 depth/1.png\n10.08 depth/2.png\n"); }
  [[nodiscard]] std::unique_ptr<RecordingReader> open(const RecordingCorrection& correction = {}) const {
    return openRecording(folder_.path(), correction);
  }
  [[nodiscard]] std::vector<std::string> guesses(const RecordingCorrection& correction = {}) const {
    return open(correction)->info().guesses;
  }
  static float depthOf(RecordingReader& recording) {
    DepthFrame frame;
    recording.read(0, frame);
    return frame.depth.at(0, 0);
  }

  TemporaryFolder folder_;
};

TEST_F(TumFolder, OfTheBenchmarkHasNothingToGuess) {
  usualList();
  EXPECT_TRUE(guesses().empty());
  EXPECT_EQ(depthOf(*open()), 2.0F);
  EXPECT_NEAR(open()->info().fps, 25, 1e-9);
}

TEST_F(TumFolder, IsReadWithTabsSeveralBlanksAndAByteOrderMark) {
  list("\xEF\xBB\xBF# list\r\n10.0\tdepth/0.png\r\n10.04  \t depth/1.png \r\n  10.08   depth/2.png\r\n");
  const auto recording = open();
  EXPECT_EQ(recording->frameCount(), 3U);
  EXPECT_EQ(recording->time(2), 10.08);
  EXPECT_TRUE(recording->info().guesses.empty());
}

TEST_F(TumFolder, InMillimetresIsTakenSoWithOneLine) {
  writePictures(640, 480, 2500);
  usualList();
  ASSERT_EQ(guesses().size(), 1U);
  EXPECT_NE(guesses()[0].find("nearer than 0.50 m"), std::string::npos) << guesses()[0];
  EXPECT_NE(guesses()[0].find("--depth-unit"), std::string::npos) << guesses()[0];
  EXPECT_EQ(depthOf(*open()), 2.5F);
}

TEST_F(TumFolder, HasTheUnitThatIsGiven) {
  writePictures(640, 480, 2500);
  usualList();
  RecordingCorrection correction;
  correction.depth_unit_m = 0.0002;
  EXPECT_TRUE(guesses(correction).empty());
  EXPECT_EQ(depthOf(*open(correction)), 0.5F);
}

TEST_F(TumFolder, HasTheSizeOfItsFirstPicture) {
  writePictures(1280, 720, 10000);
  usualList();
  const auto recording = open();
  EXPECT_EQ(recording->info().camera.width, 1280);
  EXPECT_EQ(recording->info().camera.height, 720);
  EXPECT_EQ(recording->info().camera.fx, 640) << "as the imagers of RealSense cameras";
  ASSERT_EQ(recording->info().guesses.size(), 1U);
  EXPECT_NE(recording->info().guesses[0].find("--camera"), std::string::npos);
  EXPECT_EQ(depthOf(*recording), 2.0F);
  RecordingCorrection given;
  given.camera.emplace();
  given.camera->camera = usualCamera(1280, 720);
  given.camera->depth_unit_m = 0.0002;
  EXPECT_TRUE(guesses(given).empty());
}

TEST_F(TumFolder, PassesOverARowWithTheTimeOfTheRowBefore) {
  list("10.0 depth/0.png\n10.04 depth/1.png\n10.04 depth/2.png\n");
  ASSERT_EQ(guesses().size(), 1U);
  EXPECT_NE(guesses()[0].find("2.png"), std::string::npos) << guesses()[0];
  EXPECT_EQ(open()->frameCount(), 2U);
  list("10.0 depth/0.png\n10.04 depth/1.png\n10.02 depth/2.png\n");
  EXPECT_NE(errorOf([&] { (void)open(); }).find("line 3: times must grow"), std::string::npos);
}

TEST_F(TumFolder, IsReadByItsAssociationsAlone) {
  for (const char* row : {"10.0 rgb/0.png 10.01 depth/0.png\n", "10.01 depth/0.png 10.0 rgb/0.png\n"}) {
    list(row, "associations.txt");
    const auto recording = open();
    EXPECT_EQ(recording->time(0), 10.01) << row;
    EXPECT_EQ(depthOf(*recording), 2.0F);
  }
  list("10.0 rgb/0.png 10.01 rgb/1.png\n", "associations.txt");
  EXPECT_NE(errorOf([&] { (void)open(); }).find("neither file is a 16-bit"), std::string::npos);
}

TEST_F(TumFolder, TakesNumbersForFramesNotForSeconds) {
  list("1 depth/0.png\n2 depth/1.png\n3 depth/2.png\n");
  const auto recording = open();
  EXPECT_NEAR(recording->info().fps, 30, 1e-9);
  EXPECT_NEAR(recording->time(2) - recording->time(0), 2.0 / 30, 1e-12);
  EXPECT_EQ(recording->info().guesses.size(), 1U);
}

TEST_F(TumFolder, RefusesWhatNobodyMeant) {
  list("10.0\n");
  EXPECT_NE(errorOf([&] { (void)open(); }).find("a time and a file name"), std::string::npos);
  list("1e300 depth/0.png\n");
  EXPECT_LT(errorOf([&] { (void)open(); }).size(), 200U + folder_.path().string().size());
  list("0 depth/0.png\n1e-300 depth/1.png\n");
  EXPECT_NE(errorOf([&] { (void)open(); }).find("fps"), std::string::npos);
}

}  // namespace
}  // namespace depthmocap
