#include <algorithm>
#include <chrono>
#include <deque>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "depthmocap/error.h"
#include "libtracker/classify/part_classifier.h"
#include "libtracker/classify/room_classifier.h"
#include "libtracker/posedb/pose_database.h"
#include "libtracker/session/live_session.h"
#include "libtracker/session/replay_session.h"
#include "tests/support/made_recording.h"
#include "tests/support/scripted_source.h"

namespace depthmocap {
namespace {

// Nobody is in these pictures, so any classifier does.
class NoParts : public PartClassifier {
 public:
  [[nodiscard]] std::unique_ptr<Memory> newMemory() const override { return std::make_unique<Memory>(); }
  [[nodiscard]] bool tellsFacings() const override { return false; }
  void classify(const DepthImage&, const MaskImage&, const CameraModel&, const ClassifyConfig&, Memory&,
                ClassifiedPixels& result) const override {
    result.pixels.clear();
  }
  void assumeFacing(const FacingShares&, int, const Memory&, ClassifiedPixels&) const override {}
};

Models emptyModels() {
  Models models;
  models.classifier = std::make_shared<const NoParts>();
  models.room = std::make_shared<const RoomClassifier>(
      loadRoomNetwork(std::string(DEPTHMOCAP_SOURCE_DIR) + "/forest/models/rooms.network"));
  PoseDatabase database;
  database.poses.emplace_back().setZero();
  database.poses.emplace_back().setConstant(0.1F);
  models.database = std::make_shared<const PoseDatabase>(database);
  return models;
}

// Pattern frames in memory; some cannot be read.
class MadeReader : public RecordingReader {
 public:
  explicit MadeReader(int frames, std::vector<int> damaged = {}) : frames_(frames), damaged_(std::move(damaged)) {}
  [[nodiscard]] const RecordingInfo& info() const override { return info_; }
  [[nodiscard]] std::size_t frameCount() const override { return static_cast<std::size_t>(frames_); }
  void read(std::size_t i, DepthFrame& frame) override {
    const int number = static_cast<int>(i);
    if (std::find(damaged_.begin(), damaged_.end(), number) != damaged_.end()) throw Error("damaged", "a frame");
    frame = patternFrame(info_.camera, number, info_.fps);
  }
  [[nodiscard]] std::int64_t frameNumber(std::size_t i) const override { return static_cast<std::int64_t>(i); }
  [[nodiscard]] double time(std::size_t i) const override { return static_cast<double>(i) / info_.fps; }
  void believe(const CameraModel& camera, double depth_unit_m) override {
    info_.camera = camera;
    info_.depth_unit_m = depth_unit_m;
  }

 private:
  RecordingInfo info_ = smallCamera();
  int frames_;
  std::vector<int> damaged_;
};

// Notes what came, and on which sink.
class Notes : public FrameSink {
 public:
  Notes(std::string name, std::vector<std::string>& log) : name_(std::move(name)), log_(log) {}
  void onFrame(const SessionFrame& frame) override {
    EXPECT_EQ(frame.depth.frame, frame.tracked.frame);
    log_.push_back(name_ + std::to_string(frame.tracked.frame));
    depths.push_back(frame.depth.depth.at(3, 2));
  }
  void onStatus(const SessionStatus& status) override { last = status; }
  SessionStatus last;
  std::vector<float> depths;

 private:
  std::string name_;
  std::vector<std::string>& log_;
};

class Sessions : public testing::Test {
 protected:
  Tracker tracker_{emptyModels(), smallCamera().camera};
  std::vector<std::string> log_;
  Notes a_{"a", log_};
  Notes b_{"b", log_};
};

TEST_F(Sessions, EverySinkGetsEveryFrameInOrder) {
  MadeReader reader(3);
  ReplaySession session(reader, tracker_, {.look_ahead_s = 0});
  session.addSink(a_);
  session.addSink(b_);
  session.run();
  EXPECT_EQ(log_, (std::vector<std::string>{"a0", "b0", "a1", "b1", "a2", "b2"}));
  EXPECT_EQ(session.stats().frames(), 3U);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(a_.depths[static_cast<std::size_t>(i)], patternDepth(smallCamera().camera, i).at(3, 2));
  }
}

TEST_F(Sessions, LookAheadChangesNeitherOrderNorDepth) {
  MadeReader reader(12);
  ReplaySession session(reader, tracker_, {.look_ahead_s = 0.13});
  session.addSink(a_);
  session.run();
  ASSERT_EQ(log_.size(), 12U);
  for (int i = 0; i < 12; ++i) {
    EXPECT_EQ(log_[static_cast<std::size_t>(i)], "a" + std::to_string(i));
    EXPECT_EQ(a_.depths[static_cast<std::size_t>(i)], patternDepth(smallCamera().camera, i).at(3, 2));
  }
}

TEST_F(Sessions, AFrameThatCannotBeReadIsEmptyAndSaid) {
  MadeReader reader(4, {1, 2});
  ReplaySession session(reader, tracker_, {.look_ahead_s = 0});
  session.addSink(a_);
  std::vector<std::string> warnings;
  std::size_t progress = 0;
  session.run({[&](std::size_t done, std::size_t) { progress = done; },
               [&](const std::string& text) { warnings.push_back(text); },
               {}});
  EXPECT_EQ(log_, (std::vector<std::string>{"a0", "a1", "a2", "a3"}));
  ASSERT_EQ(warnings.size(), 1U) << "one reason is one line";
  EXPECT_NE(warnings[0].find("2 frames"), std::string::npos) << warnings[0];
  EXPECT_EQ(progress, 8U) << "its frames are read once for the body, once for the poses";
  EXPECT_EQ(a_.depths[1], 0.0F);
  EXPECT_NE(a_.depths[3], 0.0F);
}

TEST_F(Sessions, OnePassReadsEachFrameOnce) {
  MadeReader reader(4);
  ReplaySession session(reader, tracker_, {.look_ahead_s = 0, .passes = 1});
  std::size_t total = 0;
  session.run({[&](std::size_t, std::size_t all) { total = all; }, {}, {}});
  EXPECT_EQ(total, 4U);
}

TEST_F(Sessions, RefusesWhereNothingIsChosenOrReadable) {
  MadeReader reader(3, {0, 1, 2});
  EXPECT_THROW(ReplaySession(reader, tracker_, {.first_frame = 9}), Error);
  ReplaySession session(reader, tracker_, {.name = "take 5"});
  try {
    session.run();
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()).rfind("take 5: no frame", 0), 0U) << error.what();
  }
}

TEST_F(Sessions, StopsWhereItIsToldTo) {
  MadeReader reader(50);
  ReplaySession session(reader, tracker_, {.look_ahead_s = 0.13});
  session.addSink(a_);
  session.run({{}, {}, [&] { return session.stats().frames() == 7; }});
  EXPECT_EQ(log_.size(), 7U) << "frames that waited are passed on";
}

TEST_F(Sessions, ASinkThatFailsEndsTheRun) {
  class Failing : public FrameSink {
    void onFrame(const SessionFrame&) override { throw Error("disk full", "sink"); }
  } failing;
  MadeReader reader(3);
  ReplaySession session(reader, tracker_, {.look_ahead_s = 0});
  session.addSink(a_);
  session.addSink(failing);
  EXPECT_THROW(session.run(), Error);
  EXPECT_EQ(log_, (std::vector<std::string>{"a0"}));
}

TEST_F(Sessions, ACameraGoesTheSameWay) {
  using Script = ScriptedSource;
  ScriptedSource source({Script::frame(0), {SourceState::Damaged, 0}, Script::frame(2)});
  LiveSession session(source, tracker_, nullptr, {});
  session.addSink(a_);
  session.run();
  ASSERT_FALSE(log_.empty());
  EXPECT_EQ(log_.back(), "a2") << "the newest frame is never left out";
  EXPECT_EQ(session.figures().received, 2);
  EXPECT_EQ(session.figures().damaged, 1);
  EXPECT_EQ(static_cast<std::int64_t>(log_.size()) + session.figures().replaced, 2);
  EXPECT_EQ(a_.last.tracked, static_cast<std::int64_t>(log_.size()));
}

TEST_F(Sessions, ACameraNeverWaitsForASlowSink) {
  class Slow : public FrameSink {
    void onFrame(const SessionFrame&) override { std::this_thread::sleep_for(std::chrono::milliseconds(20)); }
  } slow;
  constexpr int kFrames = 50;
  std::deque<ScriptedSource::Step> script;
  for (int i = 0; i < kFrames; ++i) script.push_back(ScriptedSource::frame(i));
  ScriptedSource source(script);
  LiveSession session(source, tracker_, nullptr, {});
  session.addSink(a_);
  session.addSink(slow);
  session.run();
  EXPECT_EQ(session.figures().received, kFrames);
  EXPECT_GT(session.figures().replaced, 0) << "frames come at once, the sink takes 20 ms for each";
  EXPECT_EQ(static_cast<std::int64_t>(log_.size()) + session.figures().replaced, kFrames);
  EXPECT_EQ(log_.back(), "a" + std::to_string(kFrames - 1)) << "the newest frame is never left out";
}

}  // namespace
}  // namespace depthmocap
