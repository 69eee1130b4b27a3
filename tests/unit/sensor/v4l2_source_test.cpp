#include "libtracker/sensor/v4l2_source.h"

#include <cmath>

#include <gtest/gtest.h>

#include "libtracker/sensor/returning_source.h"
#include "libtracker/sensor/v4l2_format.h"
#include "tests/support/fake_v4l2.h"
#include "tests/support/made_recording.h"
#include "tests/support/temporary_folder.h"

namespace depthmocap {
namespace {

constexpr const char* kDevice = "/dev/video7";
constexpr std::chrono::milliseconds kShort{1};

class V4l2SourceTest : public testing::Test {
 protected:
  ~V4l2SourceTest() override {
    EXPECT_EQ(fake_.open_devices, 0);
    EXPECT_EQ(fake_.mapped, 0);
    EXPECT_EQ(fake_.misuse, "");
  }
  std::unique_ptr<DepthSource> open(const SourceOptions& options = {}) {
    return openV4l2Camera(kDevice, options, fake_);
  }
  std::string openError(const SourceOptions& options = {}) {
    return errorOf([&] { open(options); });
  }
  // A picture whose pixel i is `first` + i, in rows of 16 bits.
  FakeV4l2::Picture picture(std::uint32_t sequence, int first = 1000) const {
    FakeV4l2::Picture p;
    p.sequence = sequence;
    p.time_s = 100 + sequence / 30.0;
    for (std::uint32_t i = 0; i < fake_.width * fake_.height; ++i) {
      const auto value = static_cast<std::uint32_t>(first) + i;
      p.bytes.push_back(static_cast<std::uint8_t>(value & 0xFFU));
      p.bytes.push_back(static_cast<std::uint8_t>(value >> 8U));
      if ((i + 1) % fake_.width == 0) p.bytes.resize(p.bytes.size() + fake_.padding, 0xEE);
    }
    return p;
  }

  FakeV4l2 fake_;
  SensorFrame frame_;
};

TEST_F(V4l2SourceTest, StreamsMillimetres) {
  fake_.padding = 4;
  for (std::uint32_t i = 10; i < 30; ++i) fake_.pictures.push_back(picture(i, 1000 + static_cast<int>(i)));
  const auto source = open();
  EXPECT_EQ(source->info().camera.width, 8);
  EXPECT_EQ(source->info().fps, 30);
  EXPECT_EQ(source->info().depth_unit_m, 0.001);
  EXPECT_EQ(source->info().camera_name, "Fake depth camera");
  for (int i = 0; i < 20; ++i) {
    ASSERT_EQ(source->next(frame_, kShort), SourceState::Frame);
    EXPECT_EQ(frame_.depth.frame, i);
    EXPECT_NEAR(frame_.depth.time_s, i / 30.0, 1e-5);
    EXPECT_FLOAT_EQ(frame_.depth.depth.at(7, 5), static_cast<float>((1010 + i + 47) * 0.001));
    EXPECT_LE(frame_.taken, SensorClock::now());
  }
  EXPECT_EQ(source->next(frame_, kShort), SourceState::Waiting);
}

TEST_F(V4l2SourceTest, ShowsWhatTheDriverDroppedAsGaps) {
  for (const std::uint32_t i : {0xFFFFFFFEU, 0xFFFFFFFFU, 2U}) fake_.pictures.push_back(picture(i));
  fake_.pictures[0].time_s = 1;
  fake_.pictures[1].time_s = 2;
  fake_.pictures[2].time_s = 3;
  const auto source = open();
  for (const int expected : {0, 1, 4}) {
    ASSERT_EQ(source->next(frame_, kShort), SourceState::Frame);
    EXPECT_EQ(frame_.depth.frame, expected);
  }
}

TEST_F(V4l2SourceTest, CountsOnWhereTheDriverBeginsAnew) {
  for (const std::uint32_t i : {7U, 8U, 0U, 1U}) fake_.pictures.push_back(picture(i));
  for (std::size_t i = 0; i < 4; ++i) fake_.pictures[i].time_s = static_cast<double>(i + 1);
  const auto source = open();
  for (const int expected : {0, 1, 2, 3}) {
    ASSERT_EQ(source->next(frame_, kShort), SourceState::Frame);
    EXPECT_EQ(frame_.depth.frame, expected);
  }
}

TEST_F(V4l2SourceTest, CountsAndTimesForDriversThatDoNot) {
  for (int i = 0; i < 3; ++i) {
    fake_.pictures.push_back(picture(0));
    fake_.pictures.back().flags = V4L2_BUF_FLAG_TIMESTAMP_UNKNOWN;
  }
  const auto source = open();
  for (int i = 0; i < 3; ++i) {
    ASSERT_EQ(source->next(frame_, kShort), SourceState::Frame);
    EXPECT_EQ(frame_.depth.frame, i);
    EXPECT_NEAR(frame_.depth.time_s, i / 30.0, 1e-9);
    EXPECT_LE(frame_.taken, SensorClock::now());
  }
}

TEST_F(V4l2SourceTest, TakesTheDriversMonotonicTime) {
  fake_.pictures.push_back(picture(0));
  fake_.pictures.back().time_s = 1.5;  // long ago
  const auto source = open();
  ASSERT_EQ(source->next(frame_, kShort), SourceState::Frame);
  EXPECT_NEAR(std::chrono::duration<double>(frame_.taken.time_since_epoch()).count(), 1.5, 1e-5);
}

TEST_F(V4l2SourceTest, CallsShortAndBadPicturesDamaged) {
  fake_.pictures = {picture(0), picture(1), picture(2), picture(3)};
  fake_.pictures[1].bytes.resize(95);
  fake_.pictures[2].flags |= V4L2_BUF_FLAG_ERROR;
  const auto source = open();
  EXPECT_EQ(source->next(frame_, kShort), SourceState::Frame);
  EXPECT_EQ(source->next(frame_, kShort), SourceState::Damaged);
  EXPECT_NE(source->problem().find("95 of 96 bytes"), std::string::npos) << source->problem();
  EXPECT_EQ(source->next(frame_, kShort), SourceState::Damaged);
  EXPECT_EQ(source->next(frame_, kShort), SourceState::Frame);
  EXPECT_EQ(frame_.depth.frame, 3);
}

TEST_F(V4l2SourceTest, WaitsOnWhenItIsWokenForNothing) {
  const auto source = open();
  fake_.wakes_without_picture = true;
  EXPECT_EQ(source->next(frame_, kShort), SourceState::Waiting);
}

TEST_F(V4l2SourceTest, IsLostWhenItIsUnplugged) {
  fake_.pictures = {picture(0)};
  fake_.unplugged_at_end = true;
  const auto source = open();
  EXPECT_EQ(source->next(frame_, kShort), SourceState::Frame);
  EXPECT_EQ(source->next(frame_, kShort), SourceState::Lost);
  EXPECT_EQ(source->problem(), "/dev/video7: the camera was unplugged");
  EXPECT_EQ(source->next(frame_, kShort), SourceState::Lost);
}

TEST_F(V4l2SourceTest, PrefersFormatsThatSayDepth) {
  fake_.formats = {V4L2_PIX_FMT_Y16, V4L2_PIX_FMT_Y10BPACK, V4L2_PIX_FMT_INZI};
  EXPECT_EQ(open()->info().depth_unit_m, 0.000125);
  SourceOptions options;
  options.pixel_format = "Y16";
  options.depth_unit_m = 0.0002;
  fake_.pictures = {picture(0, 5000)};
  const auto source = open(options);
  EXPECT_EQ(source->info().depth_unit_m, 0.0002);
  ASSERT_EQ(source->next(frame_, kShort), SourceState::Frame);
  EXPECT_FLOAT_EQ(frame_.depth.depth.at(0, 0), 1.0F);
  options.pixel_format = "Z16";
  EXPECT_NE(openError(options).find("has no pixel format Z16 (it has Y16, Y10B, INZI)"), std::string::npos);
}

TEST_F(V4l2SourceTest, ReadsTheKinectsTenBits) {
  fake_.formats = {V4L2_PIX_FMT_Y10BPACK};
  FakeV4l2::Picture p;
  p.bytes.assign(60, 0b01100100);  // five bytes for four pixels: 0x191, 0x246, 0x119, 0x064
  fake_.pictures = {p};
  const auto source = open();
  ASSERT_EQ(source->next(frame_, kShort), SourceState::Frame);
  EXPECT_FLOAT_EQ(frame_.depth.depth.at(0, 0), static_cast<float>(kinectMillimetres(2 * 0x191) * 0.001));
}

TEST_F(V4l2SourceTest, ReadsDepthBehindInfrared) {
  fake_.formats = {V4L2_PIX_FMT_INZI};
  FakeV4l2::Picture p = picture(0, 500);  // infrared
  const FakeV4l2::Picture depth = picture(0, 8000);
  p.bytes.insert(p.bytes.end(), depth.bytes.begin(), depth.bytes.end());
  fake_.pictures = {p};
  const auto source = open();
  ASSERT_EQ(source->next(frame_, kShort), SourceState::Frame);
  EXPECT_FLOAT_EQ(frame_.depth.depth.at(0, 0), 1.0F);
  EXPECT_FLOAT_EQ(frame_.depth.depth.at(7, 5), static_cast<float>((8000 + 47) * 0.000125));
}

TEST_F(V4l2SourceTest, TakesTheSizeNearestTheUsual) {
  fake_.sizes = {{1280, 720}, {640, 480}, {424, 240}};
  EXPECT_EQ(open()->info().camera.height, 480);
  SourceOptions options;
  options.mode = DepthMode{424, 240, 30};
  EXPECT_EQ(open(options)->info().camera.width, 424);
  options.mode = DepthMode{800, 600, 0};
  EXPECT_NE(openError(options).find("has no mode 800x600"), std::string::npos);
}

TEST_F(V4l2SourceTest, TakesTheLensOutOfPicturesOfTheSecondKinect) {
  fake_.width = 512;
  fake_.height = 424;
  fake_.pictures = {picture(0)};
  const auto source = open();
  EXPECT_NEAR(source->info().camera.fx, 365.456, 1e-9);
  EXPECT_FALSE(source->info().camera.hasDistortion()) << "frames come without it";
  ASSERT_EQ(source->next(frame_, kShort), SourceState::Frame);
  EXPECT_EQ(frame_.depth.depth.width, 512);
  // At the optical axis nothing moves; away from it, each pixel comes from another.
  EXPECT_FLOAT_EQ(frame_.depth.depth.at(255, 205),
                  static_cast<float>(static_cast<std::uint16_t>(1000 + 205 * 512 + 255) * 0.001));
  EXPECT_NE(frame_.depth.depth.at(40, 40),
            static_cast<float>(static_cast<std::uint16_t>(1000 + 40 * 512 + 40) * 0.001));
}

TEST_F(V4l2SourceTest, TakesACalibrationThatIsGiven) {
  SourceOptions options;
  options.camera = smallCamera();
  options.camera->camera.fx = 9;
  options.camera->depth_unit_m = 0.01;
  const auto source = open(options);
  EXPECT_EQ(source->info().camera.fx, 9);
  EXPECT_EQ(source->info().depth_unit_m, 0.01);
}

TEST_F(V4l2SourceTest, ExplainsWhatItCannotUse) {
  EXPECT_NE(errorOf([&] { openV4l2Camera("/dev/video9", {}, fake_); }).find("plugged in"), std::string::npos);
  fake_.open_error = EACCES;
  EXPECT_NE(openError().find("group 'video'"), std::string::npos) << openError();
  fake_.open_error = EBUSY;
  EXPECT_NE(openError().find("another program uses it"), std::string::npos);
  fake_.open_error = 0;
  fake_.capabilities = V4L2_CAP_VIDEO_OUTPUT | V4L2_CAP_STREAMING;
  EXPECT_NE(openError().find("does not stream pictures"), std::string::npos);
  fake_.capabilities = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
  fake_.formats = {V4L2_PIX_FMT_YUYV, V4L2_PIX_FMT_MJPEG};
  EXPECT_NE(openError().find("gives no depth"), std::string::npos);
  EXPECT_NE(openError().find("it has YUYV, MJPG"), std::string::npos) << openError();
}

TEST_F(V4l2SourceTest, CatchesDriversThatLie) {
  fake_.sets_format = V4L2_PIX_FMT_YUYV;
  EXPECT_NE(openError().find("lists the pixel format Z16, but sets YUYV"), std::string::npos) << openError();
  fake_.sets_format.reset();
  fake_.buffer_length = 95;
  EXPECT_NE(openError().find("gives 95 bytes for a picture"), std::string::npos) << openError();
  fake_.buffer_length.reset();
  fake_.width = 0;
  EXPECT_NE(openError().find("sets pictures of 0x6"), std::string::npos) << openError();
}

TEST_F(V4l2SourceTest, ComesBackAfterItWasUnplugged) {
  int opened = 0;
  FakeV4l2 fakes[3];
  for (FakeV4l2& fake : fakes) {
    fake.pictures = {picture(0), picture(1)};
    fake.unplugged_at_end = true;
  }
  const auto openNext = [&]() -> std::unique_ptr<DepthSource> { return openV4l2Camera(kDevice, {}, fakes[opened++]); };
  std::vector<std::int64_t> numbers;
  {
    ReturningSource source(openNext, {std::chrono::seconds(1), std::chrono::milliseconds(1)});
    while (numbers.size() < 6) {
      if (source.next(frame_, kShort) == SourceState::Frame) numbers.push_back(frame_.depth.frame);
    }
  }
  EXPECT_EQ(numbers, (std::vector<std::int64_t>{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(fakes[0].open_devices, 0);
}

}  // namespace
}  // namespace depthmocap
