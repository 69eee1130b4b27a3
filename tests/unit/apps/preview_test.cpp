#include "apps/draw/preview.h"

#include <csignal>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include "depthmocap/error.h"
#include "tests/support/temporary_folder.h"

namespace depthmocap {
namespace {

namespace fs = std::filesystem;

class Preview : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) /
              (std::string("preview_") + testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    camera_.width = 160;
    camera_.height = 120;
    camera_.fx = camera_.fy = 130;
    camera_.cx = 79.5;
    camera_.cy = 59.5;
    depth_ = DepthImage(160, 120, 0.0F);
    labels_ = PartImage(160, 120, 0);
    for (int y = 30; y < 110; ++y) {
      for (int x = 70; x < 90; ++x) {
        depth_.at(x, y) = 2.5F;
        labels_.at(x, y) = static_cast<std::uint8_t>(1 + y % kPartCount);
      }
    }
    row_.state = TrackState::Tracking;
    row_.p_camera.row(2).setConstant(2.5);
    row_.confidence.setOnes();
    row_.confidence[3] = 0;
    markers_.position.row(2).setConstant(2.5);
    markers_.confidence[0] = 1;
  }
  void TearDown() override { fs::remove_all(folder_); }

  PreviewFrame frame(int number) {
    row_.frame = number;
    row_.time_s = number / 30.0;
    return {&depth_, &labels_, &markers_, &row_};
  }
  std::vector<std::uint8_t> bytesOf(const fs::path& path) const {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  // Size of a PNG from its header.
  std::pair<std::uint32_t, std::uint32_t> pngSize(const fs::path& path) const {
    const std::vector<std::uint8_t> bytes = bytesOf(path);
    if (bytes.size() < 24 || bytes[1] != 'P' || bytes[2] != 'N' || bytes[3] != 'G') return {0, 0};
    const auto read = [&](std::size_t at) {
      return std::uint32_t{bytes[at]} << 24U | std::uint32_t{bytes[at + 1]} << 16U |
             std::uint32_t{bytes[at + 2]} << 8U | std::uint32_t{bytes[at + 3]};
    };
    return {read(16), read(20)};
  }
  std::size_t fileCount() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator{}));
  }

  fs::path folder_;
  CameraModel camera_;
  DepthImage depth_;
  PartImage labels_;
  MarkerSet markers_;
  JointsRow row_;
};

TEST_F(Preview, FilmAppearsWhenFinishedAndNothingElseIsLeft) {
  const fs::path path = folder_ / "film.mp4";
  PreviewWriter writer(path, camera_, 30.0);
  for (int k = 0; k < 5; ++k) writer.write(frame(k));
  EXPECT_FALSE(fs::exists(path));
  writer.finish();
  ASSERT_TRUE(fs::exists(path));
  EXPECT_EQ(fileCount(), 1U);
  const std::vector<std::uint8_t> bytes = bytesOf(path);
  ASSERT_GT(bytes.size(), 1000U);
  EXPECT_EQ(std::string(bytes.begin() + 4, bytes.begin() + 8), "ftyp");
}

TEST_F(Preview, FilmCutShortIsKept) {
  const fs::path path = folder_ / "film.mp4";
  {
    PreviewWriter writer(path, camera_, 15.0);
    writer.write(frame(0));
  }
  EXPECT_TRUE(fs::exists(path));
}

TEST_F(Preview, FilmWithoutAFrameLeavesNothing) {
  { const PreviewWriter writer(folder_ / "film.mp4", camera_, 15.0); }
  EXPECT_EQ(fileCount(), 0U);
}

TEST_F(Preview, MissingFolderIsAnErrorThatNamesTheFile) {
  const fs::path path = folder_ / "no_such_folder" / "film.mp4";
  try {
    PreviewWriter writer(path, camera_, 30.0);
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find(path.string()), std::string::npos);
  }
}

TEST_F(Preview, LostFramesEmptyImagesAndMissingPartsAreDrawn) {
  ContactSheet sheet(folder_ / "sheet.png", camera_);
  const DepthImage nothing(160, 120, 0.0F);
  const PartImage no_labels;
  row_.state = TrackState::Lost;
  sheet.add({&nothing, &no_labels, nullptr, &row_});
  sheet.add({&nothing, nullptr, nullptr, nullptr});
  row_.state = TrackState::Coasting;
  row_.p_camera.row(2).setConstant(-1.0);  // behind the camera
  sheet.add(frame(2));
  EXPECT_NO_THROW(sheet.finish());
}

TEST_F(Preview, ContactSheetHoldsAtMostTwelvePictures) {
  for (const int frames : {1, 40}) {
    const fs::path path = folder_ / "sheet.png";
    ContactSheet sheet(path, camera_);
    for (int k = 0; k < frames; ++k) sheet.add(frame(k));
    sheet.finish();
    const auto expected = frames == 1 ? std::pair{640U, 260U} : std::pair{3U * 640U + 12U, 4U * 260U + 18U};
    EXPECT_EQ(pngSize(path), expected);
  }
}

TEST_F(Preview, ContactSheetWithoutAFrameIsAnError) {
  ContactSheet sheet(folder_ / "sheet.png", camera_);
  EXPECT_THROW(sheet.finish(), Error);
  EXPECT_EQ(fileCount(), 0U);
}

// OpenCV writes on without a word; a limit of the file's size fails as a full disk does.
TEST_F(Preview, NoticesAFilmThatIsCutShort) {
  writeBytes(folder_ / "a.mp4", "old");
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit limit{};
  getrlimit(RLIMIT_FSIZE, &limit);
  const rlimit small{.rlim_cur = 20'000, .rlim_max = limit.rlim_max};
  PreviewWriter writer(folder_ / "a.mp4", camera_, 30);
  setrlimit(RLIMIT_FSIZE, &small);
  for (int i = 0; i < 40; ++i) writer.write(frame(i));
  const std::string message = errorOf([&] { writer.finish(); });
  setrlimit(RLIMIT_FSIZE, &limit);
  std::signal(SIGXFSZ, old_handler);
  EXPECT_NE(message.find("the film could not be written"), std::string::npos);
  EXPECT_EQ(readBytes(folder_ / "a.mp4"), "old");
}

TEST_F(Preview, GoesThroughAPipe) {
  ASSERT_EQ(mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  std::string film;
  std::thread reader([&] { film = readBytes(folder_ / "pipe"); });
  {
    PreviewWriter writer(folder_ / "pipe", camera_, 30);
    writer.write(frame(0));
    writer.finish();
  }
  reader.join();
  EXPECT_EQ(film.substr(4, 4), "ftyp");
  EXPECT_TRUE(fs::is_fifo(folder_ / "pipe"));
}

}  // namespace
}  // namespace depthmocap
