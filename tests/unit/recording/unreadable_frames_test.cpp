#include "libtracker/recording/unreadable_frames.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace depthmocap {
namespace {

TEST(UnreadableFrames, ASeriesIsOneLine) {
  UnreadableFrames frames;
  for (int i = 3; i < 16; ++i) frames.add(Error("is 320x240 pixels, not 640x480", fmt::format("rec/{:06d}.png", i)));
  frames.add(Error("cannot be read: No such file", "rec/000020.png"));
  const std::vector<std::string> lines = frames.lines("skipped");
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0], "rec/000003.png: is 320x240 pixels, not 640x480, and so 13 frames in all; skipped");
  EXPECT_EQ(lines[1], "rec/000020.png: cannot be read: No such file; frame skipped");
}

TEST(UnreadableFrames, ManyReasonsAreAFewLines) {
  UnreadableFrames frames;
  for (char c = 'a'; c <= 'z'; ++c) frames.add(Error(std::string("broken by ") + c, "rec"));
  EXPECT_EQ(frames.lines("skipped").size(), 6U);
  EXPECT_NE(frames.lines("skipped").back().find("21 more frames"), std::string::npos);
}

TEST(UnreadableFrames, NoneSayNothing) {
  EXPECT_TRUE(UnreadableFrames().lines("skipped").empty());
}

}  // namespace
}  // namespace depthmocap
