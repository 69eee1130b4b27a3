#include "libtracker/sensor/open_source.h"

#include <gtest/gtest.h>

#include "tests/support/made_recording.h"
#include "tests/support/temporary_folder.h"

namespace depthmocap {
namespace {

TEST(OpenSource, PlaysARecording) {
  const TemporaryFolder folder;
  makeRecording(folder / "rec:1", smallCamera(), 2);
  SourceOptions unpaced;
  unpaced.speed = 0;
  const auto source = openSource("replay:" + (folder / "rec:1").string(), unpaced);
  EXPECT_EQ(source->info().camera.width, 8);
}

TEST(OpenSource, RefusesNamesOfNoSource) {
  for (const char* name : {"", "webcam", "replay", "replay:", "openni", "v4l2", "v4l2:"}) {
    EXPECT_NE(checkSourceName(name), "") << name;
    EXPECT_NE(errorOf([&] { openSource(name, {}); }), "") << name;
  }
}

TEST(OpenSource, ReadsModes) {
  const auto mode = parseDepthMode("320x240@29.97");
  ASSERT_TRUE(mode);
  EXPECT_EQ(mode->width, 320);
  EXPECT_EQ(mode->height, 240);
  EXPECT_DOUBLE_EQ(mode->fps, 29.97);
  EXPECT_EQ(parseDepthMode("640x480")->fps, 0);
  for (const char* text : {"", "640", "x", "640x", "640x480@", "0x480", "-1x2", "640x480@-3", "640x480x3", "99999x1"}) {
    EXPECT_FALSE(parseDepthMode(text)) << text;
  }
}

}  // namespace
}  // namespace depthmocap
