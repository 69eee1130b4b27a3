#include "depthmocap/tracker.h"

#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "depthmocap/error.h"
#include "forest/render/synthesize.h"
#include "libtracker/actor/make_actor.h"
#include "libtracker/body/builtin_body.h"
#include "libtracker/choreography/procedural_motions.h"
#include "libtracker/classify/forest_classifier.h"
#include "libtracker/classify/forest_file.h"
#include "libtracker/classify/room_classifier.h"
#include "libtracker/posedb_build/build_pose_database.h"
#include "libtracker/recording/recording.h"
#include "libtracker/recording/track_files.h"
#include "libtracker/tracker/measurement.h"
#include "libtracker/tracker/tracker_config.h"
#include "tests/support/recording_excerpt.h"
#include "tests/support/temporary_folder.h"

namespace depthmocap {
namespace {

constexpr double kFrame_s = 1.0 / 30.0;
constexpr double kClose_m = 0.08;  // mean joint error of a body whose size was not given, on these frames

// The forest that comes with the program and a small database of its own motions.
const Models& models() {
  static const Models loaded = [] {
    Models made;
    made.classifier = std::make_shared<const ForestClassifier>(
        loadForest(std::string(DEPTHMOCAP_SOURCE_DIR) + "/forest/models/general.forest"));
    made.room = std::make_shared<const RoomClassifier>(
        loadRoomNetwork(std::string(DEPTHMOCAP_SOURCE_DIR) + "/forest/models/rooms.network"));
    std::vector<MotionClip> clips;
    for (const char* name : {"walk", "squat", "box"}) {
      for (const std::string& motion : proceduralMotionNames()) {
        if (motion.starts_with(name)) clips.push_back(proceduralMotion(motion, 1));
      }
    }
    made.database = std::make_shared<const PoseDatabase>(buildPoseDatabase(clips, {}).database);
    return made;
  }();
  return loaded;
}

// Some frames of a recording with their true joints.
struct Frames {
  CameraModel camera;
  std::vector<DepthFrame> frames;
  std::vector<JointsRow> truth;

  static Frames read(const std::filesystem::path& folder, std::size_t count) {
    Frames result;
    const auto reader = openRecording(folder);
    result.camera = reader->info().camera;
    result.frames.resize(std::min(count, reader->frameCount()));
    for (std::size_t i = 0; i < result.frames.size(); ++i) reader->read(i, result.frames[i]);
    result.truth = readJointsFile(folder / "truth" / "joints.csv");
    return result;
  }
  [[nodiscard]] double error(const TrackedFrame& tracked, std::size_t i) const {
    return (tracked.joints_camera - truth[i].p_camera).colwise().norm().mean();
  }
};

const Frames& walk() {
  static const Frames frames = Frames::read(bundledRecording("walk"), 40);
  return frames;
}

DepthFrame blank(const CameraModel& camera, std::int64_t number, double time_s) {
  return {number, time_s, DepthImage(camera.width, camera.height, 0.0F)};
}

TEST(Tracker, FollowsAWalk) {
  Tracker tracker(models(), walk().camera);
  for (std::size_t i = 0; i < walk().frames.size(); ++i) {
    const TrackedFrame& tracked = tracker.process(walk().frames[i]);
    ASSERT_EQ(tracked.state, TrackState::Tracking) << "frame " << i;
    EXPECT_EQ(tracked.reinitialised, i == 0) << "frame " << i;
    EXPECT_LT(walk().error(tracked, i), kClose_m) << "frame " << i;
    EXPECT_GT(tracked.confidence.mean(), 0.3);
  }
  EXPECT_NEAR(tracker.actor().stature_m(), 1.80, 0.10) << "the size of the first second; 1.72 at the start";
}

// The actor of a recording without background, before a wall.
DepthFrame beforeAWall(DepthFrame frame) {
  constexpr float kWall_m = 4.6F;
  for (float& z : frame.depth.data) z = z > 0 ? z : kWall_m;
  return frame;
}

TEST(Tracker, AFirstPoseInARoomNeedsAHeadOnANeck) {
  TrackerConfig strict;
  strict.policy.min_head = 1;  // more than any head has
  Tracker usual(models(), walk().camera);
  Tracker doubting(models(), walk().camera, strict);
  Tracker without_room(models(), walk().camera, strict);
  EXPECT_EQ(usual.process(beforeAWall(walk().frames[0])).state, TrackState::Tracking);
  EXPECT_EQ(doubting.process(beforeAWall(walk().frames[0])).state, TrackState::Lost);
  EXPECT_EQ(without_room.process(walk().frames[0]).state, TrackState::Tracking) << "nobody else can be meant";
}

TEST(Tracker, GivesTheSamePosesForAnyNumberOfThreads) {
  TrackerConfig one, three;
  one.threads = 1;
  three.threads = 3;
  Tracker a(models(), walk().camera, one);
  Tracker b(models(), walk().camera, three);
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_EQ(a.process(walk().frames[i]).q, b.process(walk().frames[i]).q) << "frame " << i;
  }
}

TEST(Tracker, CoastsThenLosesThenFindsTheActorAgain) {
  Tracker tracker(models(), walk().camera);
  std::size_t next = 0;
  for (; next < 10; ++next) tracker.process(walk().frames[next]);
  double time_s = walk().frames[next - 1].time_s;
  const auto processBlank = [&] { return tracker.process(blank(walk().camera, 100, time_s += kFrame_s)).state; };
  for (int i = 0; i < 5; ++i) EXPECT_EQ(processBlank(), TrackState::Coasting);
  for (int i = 0; i < 15; ++i) processBlank();
  EXPECT_EQ(processBlank(), TrackState::Lost);
  for (int i = 0; i < 5; ++i, ++next) {
    DepthFrame frame = walk().frames[next];
    frame.time_s = time_s += kFrame_s;
    const TrackedFrame& tracked = tracker.process(frame);
    EXPECT_EQ(tracked.state, TrackState::Tracking);
    EXPECT_EQ(tracked.reinitialised, i == 0);
    EXPECT_LT(walk().error(tracked, next), kClose_m);
  }
}

TEST(Tracker, ResetLooksForSomebodyAnewAndForgetsTheSize) {
  Tracker tracker(models(), walk().camera);
  for (std::size_t i = 0; i < 10; ++i) tracker.process(walk().frames[i]);
  tracker.reset();
  EXPECT_NEAR(tracker.actor().stature_m(), TrackPolicy{}.assumed_stature_m, 1e-9);
  const TrackedFrame& tracked = tracker.process(walk().frames[10]);
  EXPECT_TRUE(tracked.reinitialised);
  EXPECT_LT(walk().error(tracked, 10), kClose_m);
}

// Two people side by side: the actor's pixels once more, moved to the right.
DepthFrame twice(DepthFrame frame, int shift) {
  const DepthImage one = frame.depth;
  for (int y = 0; y < one.height; ++y) {
    for (int x = shift; x < one.width; ++x) {
      if (one.at(x - shift, y) > 0) frame.depth.at(x, y) = one.at(x - shift, y);
    }
  }
  return frame;
}

TEST(Tracker, LockOnFollowsThePersonThatIsMeant) {
  constexpr int kShift_px = 150;
  Tracker tracker(models(), walk().camera);
  const Eigen::Vector3d left = walk().truth[0].p_camera.col(static_cast<int>(Joint::Spine));
  const Eigen::Vector3d right = left + Eigen::Vector3d(kShift_px / walk().camera.fx * left.z(), 0, 0);
  for (const Eigen::Vector3d& meant : {right, left}) {
    tracker.lockOn(meant);
    for (std::size_t i = 0; i < 4; ++i) {
      DepthFrame frame = twice(walk().frames[i], kShift_px);
      frame.time_s += meant == right ? 0.0 : 1.0;
      const TrackedFrame& tracked = tracker.process(frame);
      ASSERT_EQ(tracked.state, TrackState::Tracking);
      EXPECT_LT((tracked.joints_camera.col(static_cast<int>(Joint::Spine)) - meant).norm(), 0.3);
    }
  }
}

TEST(Tracker, SeveralPeopleHaveNumbersAndPosesOfTheirOwn) {
  constexpr int kShift_px = 150;
  TrackerConfig config;
  config.people = 3;
  Tracker tracker(models(), walk().camera, config);
  ASSERT_EQ(tracker.people().size(), 3U);
  std::array<Eigen::Vector3d, 2> first_place;
  for (std::size_t i = 0; i < 12; ++i) {
    tracker.process(twice(walk().frames[i], kShift_px));
    EXPECT_EQ(tracker.people()[2]->state, TrackState::Lost) << "two are there";
    const Eigen::Vector3d truth = walk().truth[i].p_camera.col(static_cast<int>(Joint::Spine));
    const Eigen::Vector3d beside = truth + Eigen::Vector3d(kShift_px / walk().camera.fx * truth.z(), 0, 0);
    for (std::size_t k = 0; k < 2; ++k) {
      const TrackedFrame& person = *tracker.people()[k];
      ASSERT_EQ(person.state, TrackState::Tracking) << "frame " << i;
      EXPECT_EQ(person.person, static_cast<int>(k + 1));
      const Eigen::Vector3d spine = person.joints_camera.col(static_cast<int>(Joint::Spine));
      if (i == 0) first_place[k] = spine;
      EXPECT_LT((spine - first_place[k]).norm(), 0.5) << "numbers stay";
      EXPECT_LT(std::min((spine - truth).norm(), (spine - beside).norm()), 0.25);
    }
    const auto apart = first_place[0] - first_place[1];
    EXPECT_GT(apart.norm(), 0.5) << "nobody is there twice";
  }
}

TEST(Tracker, ThereIsNoPersonBeyondTheLast) {
  Tracker tracker(models(), walk().camera);
  EXPECT_THROW(static_cast<void>(tracker.actor(2)), Error);
  EXPECT_THROW(tracker.lockOn(Eigen::Vector3d::Zero(), 0), Error);
}

TEST(Tracker, UseChangesTheBodyAndKeepsItsSize) {
  Tracker tracker(models(), walk().camera);
  for (std::size_t i = 0; i < 5; ++i) tracker.process(walk().frames[i]);
  ActorMeasurement measured;
  measured.shape = shapeVector(averageBoneLengths(1.80), 1.0);
  tracker.use(measuredActor(measured));
  EXPECT_NEAR(tracker.actor().stature_m(), 1.80, 1e-9);
  for (std::size_t i = 5; i < 20; ++i) {
    const TrackedFrame& tracked = tracker.process(walk().frames[i]);
    EXPECT_FALSE(tracked.reinitialised) << "tracking goes on";
    EXPECT_NEAR(tracked.stature_m, 1.80, 1e-9);
    EXPECT_LT(walk().error(tracked, i), kClose_m);
  }
  tracker.reset();
  EXPECT_NEAR(tracker.actor().stature_m(), 1.80, 1e-9) << "measured once";
}

// A person who turns about between two frames, faster than the tracker believes.
TEST(Tracker, TurnsAroundWhereTheImageKeepsDisputingTheSide) {
  const TemporaryFolder folder;
  const auto render = [&](const std::string& name, double yaw) {
    MotionClip clip = proceduralMotion("squat", 1);
    clip.poses.resize(std::min<std::size_t>(clip.poses.size(), 24));
    SynthesisConfig config;
    config.staging.yaw = yaw;
    config.threads = 2;
    synthesizeRecording(clip, makeBuiltinBody(BodyShape{}), config, folder / name);
    return Frames::read(folder / name, 24);
  };
  const Frames front = render("front", 0);
  const Frames back = render("back", 3.14159265358979);
  Tracker tracker(models(), front.camera);
  for (const DepthFrame& frame : front.frames) tracker.process(frame);
  bool found_anew = false;
  double error = 0;
  for (std::size_t i = 0; i < back.frames.size(); ++i) {
    DepthFrame frame = back.frames[i];
    frame.time_s += front.frames.back().time_s + kFrame_s;
    const TrackedFrame& tracked = tracker.process(frame);
    found_anew |= tracked.reinitialised;
    error = back.error(tracked, i);
  }
  EXPECT_TRUE(found_anew);
  EXPECT_LT(error, kClose_m) << "left and right are on their sides again";
}

TEST(Tracker, TheFirstPoseFindsTheSideByItself) {
  const TemporaryFolder folder;
  MotionClip clip = proceduralMotion("walk", 1);
  clip.poses.resize(3);
  for (const double yaw : {0.0, 1.5707963, 3.14159265, -1.5707963}) {
    const std::string name = std::to_string(yaw);
    SynthesisConfig config;
    config.staging.yaw = yaw;
    synthesizeRecording(clip, makeBuiltinBody(BodyShape{}), config, folder / name);
    const Frames seen = Frames::read(folder / name, 1);
    Tracker tracker(models(), seen.camera);
    EXPECT_LT(seen.error(tracker.process(seen.frames[0]), 0), 0.1) << "yaw " << yaw;
  }
}

// Whoever brings another classifier writes a class like this one and puts it into Models: the tracker needs nothing
// else. It knows the true joints of its image and takes the part of the nearest bone; `mistake` is what it says
// instead.
class NearestBone : public PartClassifier {
 public:
  using Mistake = std::function<Part(Part, std::size_t frame)>;
  explicit NearestBone(
      std::vector<JointsRow> truth, Mistake mistake = [](Part part, std::size_t) { return part; })
      : truth_(std::move(truth)), mistake_(std::move(mistake)) {}
  [[nodiscard]] std::unique_ptr<Memory> newMemory() const override { return std::make_unique<Next>(); }
  [[nodiscard]] bool tellsFacings() const override { return false; }
  void classify(const DepthImage& depth, const MaskImage& mask, const CameraModel& camera, const ClassifyConfig& config,
                Memory& memory, ClassifiedPixels& result) const override {
    const std::size_t frame = static_cast<Next&>(memory).frame++;
    const JointPositions& joints = truth_[frame].p_camera;
    result.stride = config.stride;
    result.pixels.clear();
    for (int y = 0; y < depth.height; y += config.stride) {
      for (int x = 0; x < depth.width; x += config.stride) {
        if (mask.at(x, y) == 0 || depth.at(x, y) <= 0) continue;
        auto& pixel = result.pixels.emplace_back();
        pixel.x = static_cast<std::int16_t>(x);
        pixel.y = static_cast<std::int16_t>(y);
        pixel.depth_m = depth.at(x, y);
        const Part near = nearest(joints, camera.unproject(x, y, static_cast<double>(pixel.depth_m)));
        const Part part = mistake_(near, frame);
        pixel.probability[static_cast<std::size_t>(partIndex(part))] = 1.0F;
      }
    }
  }
  void assumeFacing(const FacingShares&, int, const Memory&, ClassifiedPixels&) const override {}

 private:
  struct Next : Memory {
    std::size_t frame = 0;
  };
  static Part nearest(const JointPositions& joints, const Eigen::Vector3d& p) {
    struct Limb {
      Part part;
      Joint from, to;
    };
    static constexpr Limb kLimbs[] = {
        {Part::Head, Joint::Head, Joint::Head},
        {Part::Neck, Joint::Neck, Joint::Neck},
        {Part::LeftShoulder, Joint::LeftShoulder, Joint::LeftShoulder},
        {Part::RightShoulder, Joint::RightShoulder, Joint::RightShoulder},
        {Part::LeftUpperArm, Joint::LeftShoulder, Joint::LeftElbow},
        {Part::RightUpperArm, Joint::RightShoulder, Joint::RightElbow},
        {Part::LeftLowerArm, Joint::LeftElbow, Joint::LeftWrist},
        {Part::RightLowerArm, Joint::RightElbow, Joint::RightWrist},
        {Part::Torso, Joint::Spine, Joint::Neck},
        {Part::LeftWaist, Joint::LeftHip, Joint::LeftHip},
        {Part::RightWaist, Joint::RightHip, Joint::RightHip},
        {Part::LeftUpperLeg, Joint::LeftHip, Joint::LeftKnee},
        {Part::RightUpperLeg, Joint::RightHip, Joint::RightKnee},
        {Part::LeftLowerLeg, Joint::LeftKnee, Joint::LeftAnkle},
        {Part::RightLowerLeg, Joint::RightKnee, Joint::RightAnkle},
    };
    Part best = Part::Torso;
    double least = 1e9;
    for (const Limb& limb : kLimbs) {
      const Eigen::Vector3d a = joints.col(static_cast<int>(limb.from));
      const Eigen::Vector3d along = joints.col(static_cast<int>(limb.to)) - a;
      const double share = std::clamp((p - a).dot(along) / std::max(along.squaredNorm(), 1e-9), 0.0, 1.0);
      const double distance = (p - a - share * along).norm();
      if (distance >= least) continue;
      least = distance;
      best = limb.part;
    }
    return best;
  }
  std::vector<JointsRow> truth_;
  Mistake mistake_;
};

TEST(Tracker, ALegThatIsTakenForAnArmStaysALegWhileItsSurfaceGoesOn) {
  const TemporaryFolder folder;
  MotionClip clip = proceduralMotion("kick_forward", 1);
  clip.poses.resize(std::min<std::size_t>(clip.poses.size(), 50));
  synthesizeRecording(clip, makeBuiltinBody(BodyShape{}), {}, folder / "kick");
  const Frames kick = Frames::read(folder / "kick", clip.poses.size());
  Models mistaken = models();
  mistaken.classifier = std::make_shared<const NearestBone>(kick.truth, [](Part part, std::size_t frame) {
    if (frame < 10) return part;
    if (part == Part::RightUpperLeg) return Part::RightUpperArm;
    return part == Part::RightLowerLeg ? Part::RightLowerArm : part;
  });
  const auto meanError = [&](double suspect_misfit) {
    TrackerConfig config;
    config.policy.suspect_misfit = suspect_misfit;
    Tracker tracker(mistaken, kick.camera, config);
    double sum = 0;
    for (std::size_t i = 0; i < kick.frames.size(); ++i) sum += kick.error(tracker.process(kick.frames[i]), i);
    return sum / static_cast<double>(kick.frames.size());
  };
  EXPECT_LT(meanError(TrackPolicy{}.suspect_misfit), 0.03);
  EXPECT_GT(meanError(1e9), 0.06) << "the mistake must matter";
}

TEST(Tracker, TakesAnotherClassifier) {
  Models other = models();
  other.classifier = std::make_shared<const NearestBone>(walk().truth);
  Tracker tracker(other, walk().camera);
  for (std::size_t i = 0; i < 12; ++i) {
    const TrackedFrame& tracked = tracker.process(walk().frames[i]);
    EXPECT_EQ(tracked.state, TrackState::Tracking);
    EXPECT_LT(walk().error(tracked, i), 0.12) << "frame " << i;
  }
}

TEST(Tracker, MarkersOfAMeasurementReplaceTheFoundOnes) {
  Tracker tracker(models(), walk().camera);
  MarkerSet known;
  known.position.setConstant(2.0);
  known.confidence.setConstant(0.25);
  TrackerMeasurement::setMarkers(tracker, known);
  EXPECT_EQ(tracker.process(walk().frames[0]).markers_camera.position, known.position);
  TrackerMeasurement::setMarkers(tracker, std::nullopt);
  tracker.reset();
  EXPECT_NE(tracker.process(walk().frames[1]).markers_camera.position, known.position);
}

// Nothing but the markers judges a pose there.
TEST(Tracker, WithoutTheDenseTermAPoseFarFromItsMarkersIsNotBelieved) {
  TrackerConfig config;
  config.policy.dense_rounds = 0;
  config.policy.suspect_rms_m = 1e9;  // nothing else is tried
  Tracker tracker(models(), walk().camera, config);
  MarkerSet apart = tracker.process(walk().frames[0]).markers_camera;
  ASSERT_EQ(tracker.process(walk().frames[1]).state, TrackState::Tracking);
  for (int i = 0; i < kPartCount; ++i) apart.position(0, i) += i % 2 == 0 ? 0.6 : -0.6;
  TrackerMeasurement::setMarkers(tracker, apart);
  EXPECT_EQ(tracker.process(walk().frames[2]).state, TrackState::Coasting);
}

struct Wrong {
  const char* name;
  const char* says;
  std::function<void()> action;
};

class TrackerRefuses : public testing::TestWithParam<Wrong> {};

TEST_P(TrackerRefuses, WithAnErrorThatSaysWhatToDo) {
  try {
    GetParam().action();
    FAIL() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find(GetParam().says), std::string::npos) << error.what();
  }
}

Models without(bool classifier, bool database, bool room = false) {
  Models rest = models();
  if (room) rest.room.reset();
  if (classifier) rest.classifier.reset();
  if (database) rest.database.reset();
  return rest;
}

INSTANTIATE_TEST_SUITE_P(
    Tracker, TrackerRefuses,
    testing::Values(Wrong{"NoClassifier", "Models::shipped()", [] { Tracker(without(true, false), CameraModel{}); }},
                    Wrong{"NoDatabase", "Models::shipped()", [] { Tracker(without(false, true), CameraModel{}); }},
                    Wrong{"NoRoom", "Models::shipped()", [] { Tracker(without(false, false, true), CameraModel{}); }},
                    Wrong{"TooManyPeople", "people",
                          [] {
                            TrackerConfig config;
                            config.people = kMostPeople + 1;
                            Tracker(models(), CameraModel{}, config);
                          }},
                    Wrong{"EmptyDatabase", "Models::shipped()",
                          [] {
                            Models empty = models();
                            empty.database = std::make_shared<const PoseDatabase>();
                            Tracker(empty, CameraModel{});
                          }},
                    Wrong{"NoFocalLength", "\"fx\" must lie in",
                          [] {
                            CameraModel camera;
                            camera.fx = 0;
                            Tracker(models(), camera);
                          }},
                    Wrong{"ActorWithoutSurface", "averageActor()",
                          [] {
                            Actor actor = averageActor(1.7);
                            actor.surface.reset();
                            Tracker(models(), CameraModel{}, actor);
                          }},
                    Wrong{"UseWithoutSurface", "averageActor()",
                          [] {
                            Tracker tracker(models(), CameraModel{});
                            tracker.use(Actor{});
                          }},
                    Wrong{"FrameOfAnotherSize", "the image is 320x240, the camera's are 640x480",
                          [] {
                            Tracker tracker(models(), CameraModel{});
                            tracker.process({0, 0.0, DepthImage(320, 240, 0.0F)});
                          }},
                    Wrong{"NoThreads", "threads",
                          [] {
                            TrackerConfig config;
                            config.threads = 0;
                            Tracker(models(), CameraModel{}, config);
                          }}),
    [](const auto& tested) { return std::string(tested.param.name); });

}  // namespace
}  // namespace depthmocap
