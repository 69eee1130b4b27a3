#include "libtracker/sensor/turned_source.h"

#include <gtest/gtest.h>

#include "libtracker/sensor/open_source.h"
#include "tests/support/recording_excerpt.h"

namespace depthmocap {
namespace {

constexpr std::chrono::milliseconds kPatience{5000};

TEST(TurnedSource, HandsOutUprightPicturesWithTheirNumbersAndTimes) {
  SourceOptions as_fast_as_can_be;
  as_fast_as_can_be.speed = 0;
  const std::string name = "replay:" + bundledRecording("walk").string();
  const auto plain = openSource(name, as_fast_as_can_be);
  as_fast_as_can_be.turn_deg = 90;
  const auto turned = openSource(name, as_fast_as_can_be);
  EXPECT_EQ(turned->info().camera.width, plain->info().camera.height);
  EXPECT_EQ(turned->info().camera.fx, plain->info().camera.fy);
  EXPECT_EQ(turned->waitsForReader(), plain->waitsForReader());
  for (int i = 0; i < 3; ++i) {
    SensorFrame a;
    SensorFrame b;
    ASSERT_EQ(plain->next(a, kPatience), SourceState::Frame);
    ASSERT_EQ(turned->next(b, kPatience), SourceState::Frame);
    EXPECT_EQ(a.depth.frame, b.depth.frame);
    EXPECT_EQ(a.depth.time_s, b.depth.time_s);
    ASSERT_EQ(b.depth.depth.width, a.depth.depth.height);
    for (const auto& [u, v] : {std::pair{0, 0}, {320, 240}, {639, 10}, {5, 479}}) {
      EXPECT_EQ(b.depth.depth.at(a.depth.depth.height - 1 - v, u), a.depth.depth.at(u, v));
    }
  }
}

TEST(TurnedSource, NotTurnedIsTheSourceItself) {
  auto source = openSource("replay:" + bundledRecording("walk").string(), {});
  const DepthSource* before = source.get();
  EXPECT_EQ(turnedSource(std::move(source), 0).get(), before);
}

}  // namespace
}  // namespace depthmocap
