#include <cmath>
#include <filesystem>

#include <OpenNI.h>
#include <gtest/gtest.h>

#include "libtracker/openni/openni_runtime.h"
#include "tests/support/recording_excerpt.h"
#include "tests/support/served_camera.h"

// Files that the OpenNI2 runtime itself has recorded, from the served camera.
namespace depthmocap {
namespace {

namespace fs = std::filesystem;

constexpr int kFrames = 12;
constexpr int kRecorded = 20;

RecordingInfo camera() {
  return smallCamera(16, 12);
}

// Records what is served now, at least `pictures` of it.
void recordOni(const fs::path& file, int pictures) {
  const auto runtime = OpenNiRuntime::start();
  openni::Device device;
  ASSERT_EQ(device.open(openni::ANY_DEVICE), openni::STATUS_OK) << openni::OpenNI::getExtendedError();
  openni::VideoStream stream;
  ASSERT_EQ(stream.create(device, openni::SENSOR_DEPTH), openni::STATUS_OK);
  openni::VideoMode mode = stream.getVideoMode();
  mode.setPixelFormat(openni::PIXEL_FORMAT_DEPTH_1_MM);
  ASSERT_EQ(stream.setVideoMode(mode), openni::STATUS_OK);
  stream.setMirroringEnabled(false);
  openni::Recorder recorder;
  ASSERT_EQ(recorder.create(file.c_str()), openni::STATUS_OK);
  ASSERT_EQ(recorder.attach(stream), openni::STATUS_OK);
  recorder.start();
  ASSERT_EQ(stream.start(), openni::STATUS_OK);
  openni::VideoFrameRef frame;
  do {
    ASSERT_EQ(stream.readFrame(&frame), openni::STATUS_OK);
  } while (frame.getFrameIndex() <= pictures);
  recorder.stop();
  stream.stop();
  recorder.destroy();
}

class OniReader : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder;
    const ServedCamera served(camera(), kFrames);
    recordOni(file(), kRecorded);
  }
  static void TearDownTestSuite() { delete folder_; }
  static fs::path file() { return *folder_ / "session.oni"; }

  // The picture is the one whose time it has.
  static void expectServed(const DepthFrame& frame) {
    const auto number = static_cast<int>(std::lround(frame.time_s * 30)) + first_;
    EXPECT_EQ(frame.depth.data, patternDepth(camera().camera, number % kFrames).data) << "picture " << number;
  }
  // The recorder may come late for the first pictures: which one it began with.
  static void findFirst(const DepthFrame& frame) {
    for (first_ = 0; first_ < kFrames; ++first_) {
      if (frame.depth.data == patternDepth(camera().camera, first_).data) return;
    }
    FAIL() << "the first picture was never served";
  }

  static inline TemporaryFolder* folder_ = nullptr;
  static inline int first_ = 0;
};

TEST_F(OniReader, GivesEachPictureOnceAndTheSameEachTime) {
  for (int reading = 0; reading < 3; ++reading) {
    const auto reader = openRecording(file());
    ASSERT_GE(reader->frameCount(), static_cast<std::size_t>(kRecorded) - 2);
    EXPECT_EQ(reader->info().camera.width, 16);
    EXPECT_NEAR(reader->info().camera.fx, 16, 1e-4);
    DepthFrame frame;
    for (std::size_t i = 0; i < reader->frameCount(); ++i) {
      ASSERT_NO_THROW(reader->read(i, frame));
      if (i == 0) findFirst(frame);
      EXPECT_EQ(frame.frame, static_cast<std::int64_t>(i));
      EXPECT_EQ(frame.time_s, reader->time(i));
      EXPECT_NEAR(frame.time_s, static_cast<double>(i) / 30, 1e-4);
      expectServed(frame);
    }
  }
}

TEST_F(OniReader, UnpacksPicturesOfAPersonAsTheyWere) {
  const fs::path walk = bundledRecording("walk");
  const ServedCamera served(walk);
  recordOni(*folder_ / "walk.oni", 5);
  const auto reader = openRecording(*folder_ / "walk.oni");
  const auto truth = openRecording(walk);
  EXPECT_NEAR(reader->info().camera.fx, truth->info().camera.fx, 0.01);
  DepthFrame packed;
  DepthFrame original;
  reader->read(0, packed);
  std::size_t first = 0;  // the recorder may come late for the first pictures
  for (truth->read(first, original); original.depth.data != packed.depth.data; truth->read(++first, original)) {
    ASSERT_LT(first, 10U) << "the first picture was never served";
  }
  for (std::size_t i = 1; i < reader->frameCount(); ++i) {
    reader->read(i, packed);
    truth->read(first + static_cast<std::size_t>(std::lround(packed.time_s * 30)), original);
    EXPECT_EQ(packed.depth.data, original.depth.data) << i;
  }
}

TEST_F(OniReader, GoesToAnyPicture) {
  const auto reader = openRecording(file());
  DepthFrame frame;
  reader->read(0, frame);
  findFirst(frame);
  for (const std::size_t i : {7U, 3U, 4U, 0U, 15U}) {
    reader->read(i, frame);
    EXPECT_EQ(frame.frame, static_cast<std::int64_t>(i));
    expectServed(frame);
  }
}

TEST_F(OniReader, KeepsGapsOfTheCamera) {
  const ServedCamera served(camera(), kFrames, "drop:5");
  recordOni(*folder_ / "gaps.oni", kRecorded);
  const auto reader = openRecording(*folder_ / "gaps.oni");
  const std::size_t last = reader->frameCount() - 1;
  EXPECT_GT(reader->time(last), (static_cast<double>(last) + 2.5) / 30);
}

TEST_F(OniReader, ReadsWhatIsWholeOfAFileThatIsCutShort) {
  const std::string bytes = readBytes(file());
  const std::size_t whole = openRecording(file())->frameCount();
  writeBytes(*folder_ / "cut.oni", bytes.substr(0, bytes.size() / 4));
  const auto reader = openRecording(*folder_ / "cut.oni");
  EXPECT_GT(reader->frameCount(), 2U);
  EXPECT_LT(reader->frameCount(), whole);
  DepthFrame frame;
  for (std::size_t i = 0; i < reader->frameCount(); ++i) {
    ASSERT_NO_THROW(reader->read(i, frame)) << i;
    EXPECT_NEAR(frame.time_s, static_cast<double>(i) / 30, 1e-4);
  }
}

TEST_F(OniReader, RefusesFilesThatAreNone) {
  writeBytes(*folder_ / "text.oni", "this is a text that was given the wrong name, for a test of the reader");
  EXPECT_NE(errorOf([] { openRecording(*folder_ / "text.oni"); }).find("is no OpenNI recording"), std::string::npos);
  writeBytes(*folder_ / "head.oni", readBytes(file()).substr(0, 24));
  EXPECT_NE(errorOf([] { openRecording(*folder_ / "head.oni"); }).find("no depth picture"), std::string::npos);
}

}  // namespace
}  // namespace depthmocap
