#include "libtracker/sensor/capture.h"

#include <future>
#include <vector>

#include <gtest/gtest.h>

#include "depthmocap/error.h"
#include "tests/support/scripted_source.h"
#include "tests/support/temporary_folder.h"

namespace depthmocap {
namespace {

using Step = ScriptedSource::Step;

// Runs a source to its end.
struct CaptureRun {
  explicit CaptureRun(DepthSource& source, int stop_after = 1000)
      : capture(
            source,
            [this, stop_after](SensorFrame& frame) {
              numbers.push_back(frame.depth.frame);
              return static_cast<int>(numbers.size()) < stop_after;
            },
            [this] { ended.set_value(); }) {
    ended.get_future().wait();
  }
  std::vector<std::int64_t> numbers;
  std::promise<void> ended;
  Capture capture;
};

TEST(Capture, CountsGapsInTheNumbersAsMissing) {
  ScriptedSource source({ScriptedSource::frame(2), ScriptedSource::frame(3), ScriptedSource::frame(7)});
  CaptureRun run(source);
  EXPECT_EQ(run.numbers, (std::vector<std::int64_t>{2, 3, 7}));
  EXPECT_EQ(run.capture.status().received, 3);
  EXPECT_EQ(run.capture.status().missing, 5);
}

TEST(Capture, CountsADamagedFrameOnce) {
  ScriptedSource source({ScriptedSource::frame(0), Step{SourceState::Damaged, 1}, ScriptedSource::frame(2)});
  CaptureRun run(source);
  EXPECT_EQ(run.capture.status().damaged, 1);
  EXPECT_EQ(run.capture.status().missing, 0);
  EXPECT_EQ(run.capture.status().problem, "scripted problem");
}

TEST(Capture, TellsWhetherTheCameraIsThere) {
  ScriptedSource gone({ScriptedSource::frame(0), Step{SourceState::Lost, 0}});
  EXPECT_FALSE(CaptureRun(gone).capture.status().connected);
  ScriptedSource back({Step{SourceState::Lost, 0}, ScriptedSource::frame(0)});
  EXPECT_TRUE(CaptureRun(back).capture.status().connected);
}

TEST(Capture, EndsWhenTheConsumerHasEnough) {
  ScriptedSource source({ScriptedSource::frame(0), ScriptedSource::frame(1), ScriptedSource::frame(2)},
                        SourceState::Waiting);
  EXPECT_EQ(CaptureRun(source, 2).numbers.size(), 2U);
}

TEST(Capture, EndsAfterItsSecondsAndDoesNotCountTheFrameThatComesThen) {
  ScriptedSource source({ScriptedSource::frame(0), ScriptedSource::frame(1), ScriptedSource::frame(2)});
  std::promise<void> ended;
  Capture capture(
      source, [](SensorFrame&) { return true; }, [&ended] { ended.set_value(); }, 1.5 / source.info().fps);
  ended.get_future().wait();
  EXPECT_EQ(capture.status().received, 2);
}

TEST(Capture, StopsWhileNothingComes) {
  ScriptedSource source({}, SourceState::Waiting);
  Capture capture(
      source, [](SensorFrame&) { return true; }, [] {});
  capture.stop();
  EXPECT_EQ(capture.status().received, 0);
}

TEST(Capture, PassesOnWhatTheConsumerThrows) {
  ScriptedSource source({ScriptedSource::frame(0)}, SourceState::Waiting);
  std::promise<void> ended;
  Capture capture(
      source, [](SensorFrame&) -> bool { throw Error("is full", "disk"); }, [&ended] { ended.set_value(); });
  ended.get_future().wait();
  EXPECT_EQ(errorOf([&] { capture.stop(); }), "disk: is full");
}

}  // namespace
}  // namespace depthmocap
