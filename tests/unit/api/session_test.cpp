// A session from source to callback, and the joints file, with public headers only.
#include <sstream>
#include <vector>

#include <gtest/gtest.h>

#include "depthmocap/depthmocap.h"
#include "tests/support/recording_excerpt.h"

namespace depthmocap {
namespace {

constexpr int kFrames = 8;

const Models& models() {
  static const Models shipped = Models::shipped();
  return shipped;
}

SessionOptions options() {
  SessionOptions o;
  o.models = models();
  return o;
}

class ExcerptSession : public testing::Test {
 protected:
  void SetUp() override { copyExcerpt("walk", kFrames, recording()); }
  [[nodiscard]] std::filesystem::path recording() const { return folder_ / "rec"; }

  TemporaryFolder folder_;
};

std::string jointsOf(Session& session) {
  std::ostringstream text;
  JointsCsv joints(text);
  session.run([&](const TrackedFrame& frame) { joints.write(frame); });
  return text.str();
}

TEST_F(ExcerptSession, TracksEveryFrameOfARecordingInOrder) {
  Session session(Recording(recording()), options());
  std::vector<std::int64_t> numbers;
  session.run([&](const TrackedFrame& frame, const DepthFrame& depth) {
    EXPECT_EQ(frame.frame, depth.frame);
    EXPECT_EQ(frame.state, TrackState::Tracking);
    numbers.push_back(frame.frame);
  });
  EXPECT_EQ(numbers, (std::vector<std::int64_t>{0, 1, 2, 3, 4, 5, 6, 7}));
}

TEST_F(ExcerptSession, RunsAgainWithTheSameResult) {
  Session session(Recording(recording()), options());
  const std::string first = jointsOf(session);
  EXPECT_EQ(first.substr(0, 14), "frame,time_s,s");
  EXPECT_EQ(std::count(first.begin(), first.end(), '\n'), kFrames + 1);
  EXPECT_EQ(jointsOf(session), first);
}

TEST_F(ExcerptSession, OfSeveralPeopleThoseWhoAreThereAreToldOf) {
  SessionOptions several = options();
  several.people = 3;
  Session session(Recording(recording()), several);
  std::vector<int> people;
  session.run([&](const TrackedFrame& frame) { people.push_back(frame.person); });
  EXPECT_FALSE(people.empty());
  for (const int person : people) EXPECT_EQ(person, 1) << "one is there";
}

// Statures of the body in the first and in the last frame of the bundled walk, by a man of 1.80 m, and the length of an
// upper leg in the first.
struct WalkBodies {
  double first_m = 0, last_m = 0, upper_leg_m = 0;
};
WalkBodies bodiesOfWalk(int passes) {
  SessionOptions o = options();
  o.passes = passes;
  Session session(Recording(bundledRecording("walk")), o);
  WalkBodies bodies;
  session.run([&](const TrackedFrame& frame) {
    if (bodies.first_m == 0) {
      bodies.first_m = frame.stature_m;
      bodies.upper_leg_m = frame.lengths.upper_leg;
    }
    bodies.last_m = frame.stature_m;
  });
  return bodies;
}

TEST(Passes, TwoGiveTheFirstFrameTheBodyThatTheFirstSecondsShow) {
  const WalkBodies bodies = bodiesOfWalk(2);
  EXPECT_EQ(bodies.first_m, bodies.last_m);
  EXPECT_NEAR(bodies.first_m, 1.80, 0.04);
}

TEST(Passes, OneFitsTheBodyWhileTracking) {
  const WalkBodies bodies = bodiesOfWalk(1);
  EXPECT_NE(bodies.first_m, bodies.last_m);
  EXPECT_NEAR(bodies.last_m, 1.80, 0.04);
}

TEST_F(ExcerptSession, AGivenActorKeepsItsSize) {
  SessionOptions o = options();
  o.actor = averageActor(1.60);
  Session session(Recording(recording()), o);
  session.run([](const TrackedFrame& frame) { EXPECT_NEAR(frame.stature_m, 1.60, 1e-9); });
}

TEST_F(ExcerptSession, SaysWhichFrameCannotBeRead) {
  std::ofstream(recording() / "depth" / framePng(3)) << "no picture";
  std::vector<std::string> warnings;
  SessionOptions o = options();
  o.warn = [&](const std::string& message) { warnings.push_back(message); };
  Session session(Recording(recording()), o);
  int frames = 0;
  session.run([&](const TrackedFrame&) { ++frames; });
  EXPECT_EQ(frames, kFrames);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find(framePng(3)), std::string::npos);
}

TEST_F(ExcerptSession, TracksASourceAsACamera) {
  CameraOptions camera;
  camera.speed = 0;
  Session session(Camera("replay:" + recording().string(), camera), options());
  int frames = 0;
  session.run([&](const TrackedFrame&) { ++frames; });
  EXPECT_EQ(frames, kFrames);
}

TEST_F(ExcerptSession, PassesOnWhatTheCallbackThrows) {
  Session session(Recording(recording()), options());
  EXPECT_THROW(session.run([](const TrackedFrame&) { throw std::runtime_error("mine"); }), std::runtime_error);
}

TEST_F(ExcerptSession, RefusesOptionsOutOfRange) {
  SessionOptions smooth = options();
  smooth.smooth = 2;
  EXPECT_THROW(Session(Recording(recording()), smooth), Error);
  SessionOptions threads = options();
  threads.threads = 0;
  EXPECT_THROW(Session(Recording(recording()), threads), Error);
  SessionOptions ahead = options();
  ahead.look_ahead_s = -1;
  EXPECT_THROW(Session(Recording(recording()), ahead), Error);
  SessionOptions passes = options();
  passes.passes = 3;
  EXPECT_THROW(Session(Recording(recording()), passes), Error);
}

TEST(JointsCsv, LeavesALostFrameWithoutCoordinates) {
  std::ostringstream text;
  JointsCsv joints(text);
  TrackedFrame frame;
  frame.frame = 7;
  frame.time_s = 0.25;
  joints.write(frame);
  const std::string row = text.str().substr(text.str().find('\n') + 1);
  EXPECT_EQ(row.substr(0, 22), "7,0.250000,lost,,,,0,,");
}

TEST(JointsCsv, SaysThatTheStreamHasFailed) {
  std::ostringstream text;
  JointsCsv joints(text);
  text.setstate(std::ios::badbit);
  EXPECT_THROW(joints.write({}), Error);
}

}  // namespace
}  // namespace depthmocap
