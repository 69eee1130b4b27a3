#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "forest/render/synthesize.h"
#include "libtracker/body/builtin_body.h"
#include "libtracker/choreography/procedural_motions.h"
#include "libtracker/recording/recording.h"
#include "libtracker/recording/track_files.h"
#include "tests/support/run_program.h"

// Two people in a rendered room: the lock stays on the actor.
namespace depthmocap {
namespace {

constexpr double kQuarter = 1.5707963267948966;
constexpr double kEverywhere = 100.0;  // half_view: a path that may lead out of the picture

MotionClip motion(const std::string& name, int first, int count) {
  MotionClip clip = proceduralMotion(name, 1);
  clip.poses.erase(clip.poses.begin(), clip.poses.begin() + first);
  clip.poses.resize(std::min(clip.poses.size(), static_cast<std::size_t>(count)));
  return clip;
}

class Crossing : public testing::Test {
 protected:
  Crossing() {
    config_.camera = sensorCamera(SensorKind::Kinect1, true);
    config_.scene = SceneKind::Room;
    config_.threads = 2;
  }
  // Walks through the picture from the actor's right (yaw > 0) or left.
  void walksPast(double distance_m, double yaw, int first, int count) {
    OtherPerson other{motion("walk", first, count), makeBuiltinBody(BodyShape{Sex::Female, 1.68, 62}), {}};
    other.staging.yaw = yaw;
    other.staging.distance_m = distance_m;
    other.staging.half_view = kEverywhere;
    config_.others.push_back(std::move(other));
  }
  void track(const MotionClip& clip) {
    synthesizeRecording(clip, makeBuiltinBody(BodyShape{}), config_, folder_ / "rec");
    const ProgramResult result =
        runProgram("replay " + quoted(folder_ / "rec") + " --joints " + quoted(folder_ / "j.csv"));
    ASSERT_EQ(result.exit_code, 0) << result.errors;
    truth_ = readJointsFile(folder_ / "rec/truth/joints.csv");
    tracked_ = readJointsFile(folder_ / "j.csv");
    ASSERT_EQ(truth_.size(), tracked_.size());
  }
  // Mean distance of the joints from those of the actor [m].
  [[nodiscard]] double error(std::size_t frame) const {
    return (tracked_[frame].p_camera - truth_[frame].p_camera).colwise().norm().mean();
  }
  // One character a frame: . the actor, X somebody else, c coasting, - lost.
  [[nodiscard]] std::string story() const {
    std::string story;
    for (std::size_t i = 0; i < tracked_.size(); ++i) {
      const bool far = (tracked_[i].p_camera.col(0) - truth_[i].p_camera.col(0)).norm() > 0.5;
      story += tracked_[i].state == TrackState::Lost       ? '-'
               : tracked_[i].state == TrackState::Coasting ? 'c'
               : far                                       ? 'X'
                                                           : '.';
    }
    return story;
  }
  // Frames with a tracked pose, and the mean and the largest error of these.
  struct Figures {
    int tracked = 0;
    int frames = 0;
    double mean_m = 0;
    double largest_m = 0;
  };
  [[nodiscard]] Figures figures(std::size_t first, std::size_t last) const {
    Figures f;
    for (std::size_t i = first; i <= std::min(last, tracked_.size() - 1); ++i) {
      ++f.frames;
      if (tracked_[i].state != TrackState::Tracking) continue;
      ++f.tracked;
      f.mean_m += error(i);
      f.largest_m = std::max(f.largest_m, error(i));
    }
    f.mean_m /= std::max(1, f.tracked);
    RecordProperty("tracked", f.tracked);
    RecordProperty("mean_mm", static_cast<int>(1000 * f.mean_m));
    RecordProperty("largest_mm", static_cast<int>(1000 * f.largest_m));
    return f;
  }

  const TemporaryFolder folder_;
  SynthesisConfig config_;
  std::vector<JointsRow> truth_;
  std::vector<JointsRow> tracked_;
};

TEST_F(Crossing, SomebodyWalksPastBehind) {
  walksPast(3.3, kQuarter, 20, 80);
  track(motion("greetings", 0, 80));
  const Figures f = figures(0, 79);
  EXPECT_EQ(f.tracked, f.frames);
  EXPECT_LT(f.mean_m, 0.04);
  EXPECT_LT(f.largest_m, 0.12);
}

TEST_F(Crossing, SomebodyWalksPastWithinTouchInFront) {
  walksPast(2.3, -kQuarter, 20, 80);
  track(motion("talk", 0, 80));
  const Figures f = figures(0, 79);
  EXPECT_GT(f.tracked, 55);
  EXPECT_LT(f.mean_m, 0.06);
  EXPECT_LT(f.largest_m, 0.35) << "half hidden poses are guesses, but of the actor";
  EXPECT_EQ(figures(65, 79).tracked, 15);
  EXPECT_LT(figures(65, 79).mean_m, 0.04);
}

TEST_F(Crossing, WhoWalksAwayBehindSomebodyIsFoundWhereExpected) {
  walksPast(1.7, -kQuarter, 0, 110);
  config_.staging.yaw = kQuarter;
  config_.staging.distance_m = 3.4;
  track(motion("walk", 0, 110));
  const Figures before = figures(5, 40);
  EXPECT_GT(before.tracked, 32);
  const Figures after = figures(75, 105);
  EXPECT_GT(after.tracked, 28);
  EXPECT_LT(after.mean_m, 0.10);
}

TEST_F(Crossing, WhoLeavesThePictureAndComesBackIsTheActorStill) {
  walksPast(3.8, 0, 0, 1);
  config_.others.front().clip = motion("idle", 0, 1);  // stands there all the time
  config_.staging.yaw = kQuarter;
  config_.staging.half_view = kEverywhere;
  config_.staging.distance_m = 2.4;
  MotionClip clip = motion("walk", 0, 62);  // out of the picture, and the same way back
  for (std::size_t i = clip.poses.size(); i-- > 0;) clip.poses.push_back(clip.poses[i]);
  Pose opposite = clip.poses.front();  // the middle of the path is put before the camera: thus it starts there
  opposite.head<3>() = 2 * clip.poses.front().head<3>() - clip.poses[61].head<3>();
  clip.poses.push_back(opposite);
  track(clip);
  std::string story = this->story();
  story.pop_back();
  EXPECT_EQ(std::ranges::count(story, 'X'), 0) << story;
  EXPECT_GT(std::ranges::count(story, '-'), 15) << story;
  EXPECT_GT(figures(100, 123).tracked, 20);
}

}  // namespace
}  // namespace depthmocap
