#include "libtracker/sensor/openni_source.h"

#include <gtest/gtest.h>

#include "libtracker/openni/openni_runtime.h"
#include "libtracker/sensor/returning_source.h"
#include "tests/support/served_camera.h"

// Through the real OpenNI2 runtime, with a driver that serves a recording (tests/drivers).
namespace depthmocap {
namespace {

constexpr std::chrono::milliseconds kLong{2000};
constexpr int kFrames = 12;  // served in a loop

RecordingInfo camera() {
  return smallCamera(16, 12);
}

bool isPattern(const DepthFrame& frame, std::int64_t number) {
  return frame.depth.data == patternDepth(camera().camera, static_cast<int>(number % kFrames)).data;
}

// The runtime may be late for the first pictures of a camera: which one this is, -1 if it is none.
int servedNumber(const DepthFrame& frame) {
  for (int i = 0; i < kFrames; ++i) {
    if (isPattern(frame, i)) return i;
  }
  return -1;
}

// Reads until a state other than Waiting.
SourceState next(DepthSource& source, SensorFrame& frame) {
  for (int i = 0; i < 100; ++i) {
    const SourceState state = source.next(frame, std::chrono::milliseconds(100));
    if (state != SourceState::Waiting) return state;
  }
  return SourceState::Waiting;
}

TEST(OpenNiSource, GivesEachServedPictureUnchangedAndNotMirrored) {
  const ServedCamera served(camera(), kFrames);
  const auto source = openOpenNiCamera("", {});
  EXPECT_EQ(source->info().camera.width, 16);
  EXPECT_NEAR(source->info().camera.fx, 16, 1e-4);
  EXPECT_NEAR(source->info().camera.cx, 7.5, 1e-9);
  EXPECT_EQ(source->info().depth_unit_m, 0.001);
  SensorFrame frame;
  ASSERT_EQ(next(*source, frame), SourceState::Frame);
  EXPECT_EQ(frame.depth.frame, 0);
  EXPECT_EQ(frame.depth.time_s, 0);
  const int first = servedNumber(frame.depth);
  ASSERT_GE(first, 0);
  while (frame.depth.frame < 2 * kFrames) {
    ASSERT_EQ(next(*source, frame), SourceState::Frame);
    EXPECT_LE(frame.taken, SensorClock::now());
    EXPECT_NEAR(frame.depth.time_s, static_cast<double>(frame.depth.frame) / 30.0, 1e-3);
    EXPECT_TRUE(isPattern(frame.depth, frame.depth.frame + first)) << frame.depth.frame;
  }
}

TEST(OpenNiSource, TurnsPicturesOfACameraThatInsistsOnMirroring) {
  const ServedCamera served(camera(), kFrames, "mirror");
  const auto source = openOpenNiCamera("", {});
  SensorFrame frame;
  ASSERT_EQ(next(*source, frame), SourceState::Frame);
  EXPECT_GE(servedNumber(frame.depth), 0);
}

TEST(OpenNiSource, ShowsDroppedFramesAsGaps) {
  const ServedCamera served(camera(), kFrames, "drop:5");
  const auto source = openOpenNiCamera("", {});
  SensorFrame frame;
  ASSERT_EQ(next(*source, frame), SourceState::Frame);
  const int first = servedNumber(frame.depth);
  ASSERT_GE(first, 0);
  while (frame.depth.frame < 20) {
    EXPECT_NE((frame.depth.frame + first) % 5, 4) << "this one was never sent";
    ASSERT_EQ(next(*source, frame), SourceState::Frame);
  }
}

TEST(OpenNiSource, ChoosesTheModeThatIsAskedFor) {
  const ServedCamera served(camera(), kFrames);
  SourceOptions options;
  options.mode = parseDepthMode("8x6@30");
  auto source = openOpenNiCamera("", options);
  EXPECT_EQ(source->info().camera.width, 8);
  EXPECT_NEAR(source->info().camera.fx, 8, 1e-4);
  SensorFrame frame;
  ASSERT_EQ(next(*source, frame), SourceState::Frame);
  EXPECT_EQ(frame.depth.depth.height, 6);
  source.reset();
  options.mode = parseDepthMode("640x480@30");
  const std::string error = errorOf([&] { openOpenNiCamera("", options); });
  EXPECT_NE(error.find("has no mode 640x480@30"), std::string::npos) << error;
  EXPECT_NE(error.find("it has 8x6@30, 16x12@30"), std::string::npos) << error;
}

TEST(OpenNiSource, FindsACameraByItsUriAlsoAtAnotherPort) {
  const ServedCamera served(camera(), kFrames);
  for (const char* uri : {"depthmocap-test/1@1", "depthmocap-test/1@7"}) {
    EXPECT_EQ(openOpenNiCamera(uri, {})->info().camera.width, 16) << uri;
  }
  const std::string error = errorOf([] { openOpenNiCamera("nowhere/2@1", {}); });
  EXPECT_NE(error.find("cameras found: depthmocap-test/1@1 (depthmocap Served recording)"), std::string::npos) << error;
}

TEST(OpenNiSource, TakesIntrinsicsAndDistortionFromAFile) {
  const ServedCamera served(camera(), kFrames);
  SourceOptions options;
  options.camera = camera();
  options.camera->camera.fx = 20;
  options.camera->camera.distortion = {10.0, 0, 0, 0, 0};  // all corners come from outside the picture
  auto source = openOpenNiCamera("", options);
  EXPECT_EQ(source->info().camera.fx, 20);
  SensorFrame frame;
  ASSERT_EQ(next(*source, frame), SourceState::Frame);
  EXPECT_EQ(frame.depth.depth.at(0, 0), 0);
  source.reset();
  options.camera->camera.width = 17;
  EXPECT_NE(errorOf([&] { openOpenNiCamera("", options); }).find("17x12"), std::string::npos);
}

TEST(OpenNiSource, SaysWhatToCheckWhenThereIsNoCamera) {
  const std::string error = errorOf([] { openSource("openni2", {}); });
  EXPECT_NE(error.find("no camera found"), std::string::npos) << error;
  EXPECT_NE(error.find("udev"), std::string::npos) << error;
}

TEST(OpenNiSource, IsFoundAgainEachTimeItIsUnplugged) {
  const ServedCamera served(camera(), kFrames, "unplug:4:150");
  const auto source = openSource("openni2", {});
  SensorFrame frame;
  std::int64_t last = -1;
  double last_s = -1;
  int lost = 0;
  while (source->returns() < 10) {
    const SourceState state = source->next(frame, std::chrono::milliseconds(50));
    if (state == SourceState::Lost) ++lost;
    if (state != SourceState::Frame) continue;
    EXPECT_GT(frame.depth.frame, last);
    EXPECT_GT(frame.depth.time_s, last_s);
    last = frame.depth.frame;
    last_s = frame.depth.time_s;
  }
  EXPECT_GE(lost, 10);
  EXPECT_GE(last, 20) << "four frames each time, of which the runtime may be late for the first";
  EXPECT_LE(last, 40);
  EXPECT_GT(last_s, 10 * 0.15);
}

TEST(OpenNiSource, OpensACameraAnewThatStalls) {
  const ServedCamera served(camera(), kFrames, "stall:3:1000");
  const auto runtime = OpenNiRuntime::start();  // kept: the driver's one stall must not come again
  ReturningSource source([] { return openOpenNiCamera("", {}); },
                         {std::chrono::milliseconds(200), std::chrono::milliseconds(50)});
  SensorFrame frame;
  while (source.returns() == 0) ASSERT_NE(source.next(frame, std::chrono::milliseconds(50)), SourceState::Ended);
  EXPECT_NE(source.problem().find("sent nothing for 0.2 s"), std::string::npos) << source.problem();
}

}  // namespace
}  // namespace depthmocap
