#include "libtracker/sensor/returning_source.h"

#include <vector>

#include <gtest/gtest.h>

#include "depthmocap/error.h"
#include "tests/support/scripted_source.h"
#include "tests/support/temporary_folder.h"

namespace depthmocap {
namespace {

using Step = ScriptedSource::Step;

constexpr std::chrono::milliseconds kShort{5};
constexpr ReturnPolicy kFast{std::chrono::milliseconds(30), std::chrono::milliseconds(2)};

// Opens sources one after another; null: no camera is there.
class Cameras {
 public:
  explicit Cameras(std::vector<std::unique_ptr<ScriptedSource>> cameras) : cameras_(std::move(cameras)) {}
  std::unique_ptr<DepthSource> operator()() {
    if (next_ >= cameras_.size() || !cameras_[next_]) {
      ++next_;
      throw Error("no camera found", "test");
    }
    return std::move(cameras_[next_++]);
  }

 private:
  std::vector<std::unique_ptr<ScriptedSource>> cameras_;
  std::size_t next_ = 0;
};

template <typename... Sources>
ReturningSource::Open opening(Sources... sources) {
  std::vector<std::unique_ptr<ScriptedSource>> list;
  (list.push_back(std::move(sources)), ...);
  auto cameras = std::make_shared<Cameras>(std::move(list));
  return [cameras] { return (*cameras)(); };
}

std::unique_ptr<ScriptedSource> camera(std::deque<Step> script, SourceState at_end) {
  return std::make_unique<ScriptedSource>(std::move(script), at_end);
}

SourceState nextBut(SourceState unwanted, DepthSource& source, SensorFrame& frame) {
  for (int i = 0; i < 1000; ++i) {
    const SourceState state = source.next(frame, kShort);
    if (state != unwanted) return state;
  }
  return unwanted;
}

TEST(ReturningSource, GoesOnWithACameraThatCameBack) {
  ReturningSource source(opening(camera({ScriptedSource::frame(0), ScriptedSource::frame(1)}, SourceState::Lost),
                                 nullptr, nullptr, camera({ScriptedSource::frame(0)}, SourceState::Waiting)),
                         kFast);
  SensorFrame frame;
  ASSERT_EQ(source.next(frame, kShort), SourceState::Frame);
  ASSERT_EQ(source.next(frame, kShort), SourceState::Frame);
  const double before_s = frame.depth.time_s;
  ASSERT_EQ(source.next(frame, kShort), SourceState::Lost);
  EXPECT_EQ(source.problem(), "scripted problem");
  ASSERT_EQ(nextBut(SourceState::Lost, source, frame), SourceState::Frame);
  EXPECT_EQ(frame.depth.frame, 2);
  EXPECT_GT(frame.depth.time_s, before_s);
  EXPECT_EQ(source.returns(), 1);
}

TEST(ReturningSource, OpensACameraAnewThatSendsNothing) {
  ReturningSource source(opening(camera({ScriptedSource::frame(0)}, SourceState::Waiting),
                                 camera({ScriptedSource::frame(0)}, SourceState::Waiting)),
                         kFast);
  SensorFrame frame;
  ASSERT_EQ(source.next(frame, kShort), SourceState::Frame);
  while (source.next(frame, kShort) == SourceState::Waiting) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  EXPECT_NE(source.problem().find("sent nothing for 0.03 s"), std::string::npos) << source.problem();
  EXPECT_EQ(nextBut(SourceState::Lost, source, frame), SourceState::Frame);
  EXPECT_EQ(source.returns(), 1);
}

TEST(ReturningSource, PassesOnThatThereIsNoCameraAtTheStart) {
  EXPECT_EQ(errorOf([] { ReturningSource(opening(nullptr), kFast); }), "test: no camera found");
}

}  // namespace
}  // namespace depthmocap
