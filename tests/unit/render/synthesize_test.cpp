#include "forest/render/synthesize.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include <gtest/gtest.h>

#include "depthmocap/error.h"
#include "libtracker/body/builtin_body.h"
#include "libtracker/recording/png_file.h"
#include "libtracker/recording/recording.h"
#include "libtracker/recording/track_files.h"
#include "tests/support/temporary_folder.h"

namespace depthmocap {
namespace {

namespace fs = std::filesystem;

class Synthesize : public testing::Test {
 protected:
  Synthesize() { config_.camera = sensorCamera(SensorKind::Kinect1, true); }

  const TemporaryFolder folder_;
  SynthesisConfig config_;
};

const BodySurface& body() {
  static const BodySurface surface = makeBuiltinBody({.sex = Sex::Female, .stature_m = 1.66, .weight_kg = 60});
  return surface;
}

MotionClip bendingArms(int frames) {
  MotionClip clip;
  clip.name = "arms";
  for (int i = 0; i < frames; ++i) {
    Pose q = Pose::Zero();
    q[kRootTx] = 0.02 * i;
    q[kLradiusRy] = -0.1 * i;
    q[kRradiusRy] = 0.1 * i;
    clip.poses.push_back(q);
  }
  return clip;
}

std::map<std::string, std::string> filesUnder(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    files[fs::relative(entry.path(), folder).string()] = readBytes(entry.path());
  }
  return files;
}

TEST_F(Synthesize, BytesDoNotDependOnThreads) {
  config_.scene = SceneKind::Room;
  config_.threads = 1;
  synthesizeRecording(bendingArms(11), body(), config_, folder_ / "one");
  config_.threads = 3;
  synthesizeRecording(bendingArms(11), body(), config_, folder_ / "three");
  const auto one = filesUnder(folder_ / "one");
  EXPECT_EQ(one.size(), 2U + 11U + 11U + 2U);
  EXPECT_EQ(one, filesUnder(folder_ / "three"));
}

TEST_F(Synthesize, RecordingTruthAndLabelsAgree) {
  std::size_t done = 0;
  synthesizeRecording(bendingArms(5), body(), config_, folder_ / "rec", [&](std::size_t n) { done = n; });
  EXPECT_EQ(done, 5U);
  const auto reader = openRecording(folder_ / "rec");
  ASSERT_EQ(reader->frameCount(), 5U);
  EXPECT_EQ(reader->info().camera_name, "kinect1");
  const std::vector<JointsRow> joints = readJointsFile(folder_ / "rec" / "truth" / "joints.csv");
  const std::vector<PoseRow> poses = readPoseFile(folder_ / "rec" / "truth" / "pose.csv");
  ASSERT_EQ(joints.size(), 5U);
  ASSERT_EQ(poses.size(), 5U);
  DepthFrame frame;
  PartImage labels;
  for (std::size_t i = 0; i < 5; ++i) {
    reader->read(i, frame);
    const CameraModel& camera = reader->info().camera;
    readPng8(folder_ / "rec" / "truth" / "labels" / ("00000" + std::to_string(i) + ".png"), camera.width, camera.height,
             labels);
    for (std::size_t p = 0; p < labels.data.size(); ++p) EXPECT_EQ(labels.data[p] != 0, frame.depth.data[p] > 0.0F);
    EXPECT_DOUBLE_EQ(frame.time_s, joints[i].time_s);
    EXPECT_NEAR(poses[i].q[kLradiusRy], -0.1 * static_cast<double>(i), 1e-6);
    for (const Joint joint : {Joint::Pelvis, Joint::Spine, Joint::LeftKnee, Joint::RightElbow}) {
      const Eigen::Vector3d p = joints[i].p_camera.col(static_cast<int>(joint));
      const Eigen::Vector2d uv = camera.project(p);
      const int x = static_cast<int>(std::lround(uv.x()));
      const int y = static_cast<int>(std::lround(uv.y()));
      ASSERT_TRUE(labels.contains(x, y));
      EXPECT_NE(labels.at(x, y), 0);
      EXPECT_NEAR(frame.depth.at(x, y), p.z() - 0.07, 0.09);
    }
  }
}

TEST_F(Synthesize, JointsOutsideTheImageHaveNoConfidence) {
  config_.staging.distance_m = 0.8;  // too near for head and feet
  synthesizeRecording(bendingArms(1), body(), config_, folder_ / "rec");
  const JointsRow row = readJointsFile(folder_ / "rec" / "truth" / "joints.csv").front();
  EXPECT_EQ(row.confidence[static_cast<int>(Joint::Pelvis)], 1.0);
  EXPECT_EQ(row.confidence[static_cast<int>(Joint::LeftAnkle)], 0.0);
  EXPECT_EQ(row.confidence[static_cast<int>(Joint::LeftWrist)], 0.0);
  EXPECT_EQ(row.state, TrackState::Tracking);
}

TEST_F(Synthesize, NoiseOffGivesTheExactSurface) {
  config_.noise = false;
  synthesizeRecording(bendingArms(1), body(), config_, folder_ / "clean");
  config_.noise = true;
  synthesizeRecording(bendingArms(1), body(), config_, folder_ / "noisy");
  EXPECT_NE(filesUnder(folder_ / "clean").at("depth/000000.png"), filesUnder(folder_ / "noisy").at("depth/000000.png"));
  EXPECT_EQ(filesUnder(folder_ / "clean").at("truth/joints.csv"), filesUnder(folder_ / "noisy").at("truth/joints.csv"));
}

TEST_F(Synthesize, RefusesToOverwrite) {
  synthesizeRecording(bendingArms(1), body(), config_, folder_ / "rec");
  EXPECT_THROW(synthesizeRecording(bendingArms(1), body(), config_, folder_ / "rec"), Error);
}

// The depth of the picture at the pixel of a joint's row.
double depthAt(const DepthFrame& frame, const CameraModel& camera, const Eigen::Vector3d& p_camera) {
  const Eigen::Vector2d uv = camera.project(p_camera);
  return static_cast<double>(
      frame.depth.at(static_cast<int>(std::lround(uv.x())), static_cast<int>(std::lround(uv.y()))));
}

TEST_F(Synthesize, TruthOfATiltedCameraLiesInTheBody) {
  config_.noise = false;
  config_.camera_tilt = 0.3;
  config_.staging.camera_height_m = 1.8;
  synthesizeRecording(bendingArms(1), body(), config_, folder_ / "rec");
  const auto reader = openRecording(folder_ / "rec");
  DepthFrame frame;
  reader->read(0, frame);
  const JointsRow row = readJointsFile(folder_ / "rec" / "truth" / "joints.csv").front();
  const PoseRow pose = readPoseFile(folder_ / "rec" / "truth" / "pose.csv").front();
  for (const Joint joint : {Joint::Pelvis, Joint::Neck, Joint::LeftKnee}) {
    const Eigen::Vector3d p = row.p_camera.col(static_cast<int>(joint));
    const double behind = p.z() - depthAt(frame, config_.camera, p);
    EXPECT_GT(behind, 0.01);
    EXPECT_LT(behind, 0.2);
  }
  EXPECT_LT(std::abs(pose.q[kRootRx]), 1e-6) << "upright in the world, though not in the picture";
}

TEST_F(Synthesize, SomebodyElseHidesTheActorWhoseTruthStays) {
  config_.noise = false;
  synthesizeRecording(bendingArms(3), body(), config_, folder_ / "alone");
  config_.others.push_back({bendingArms(2), body(), {}});
  config_.others.front().staging.distance_m = 1.9;
  synthesizeRecording(bendingArms(3), body(), config_, folder_ / "two");
  EXPECT_EQ(readBytes(folder_ / "two/truth/joints.csv"), readBytes(folder_ / "alone/truth/joints.csv"));
  const JointsRow row = readJointsFile(folder_ / "two/truth/joints.csv").back();
  const Eigen::Vector3d pelvis = row.p_camera.col(static_cast<int>(Joint::Pelvis));
  DepthFrame frame;
  openRecording(folder_ / "two")->read(2, frame);
  EXPECT_LT(depthAt(frame, config_.camera, pelvis), pelvis.z() - 0.5) << "after the own motion's end, too";
  PartImage labels;
  readPng8(folder_ / "two/truth/labels/000002.png", config_.camera.width, config_.camera.height, labels);
  const Eigen::Vector2d uv = config_.camera.project(pelvis);
  EXPECT_GT(labels.at(static_cast<int>(uv.x()), static_cast<int>(uv.y())), 16);
}

TEST_F(Synthesize, FurnishedRoomsDoNotDependOnThreadsButOnTheSeed) {
  config_.scene = SceneKind::Sofa;
  config_.threads = 1;
  synthesizeRecording(bendingArms(5), body(), config_, folder_ / "one");
  config_.threads = 3;
  synthesizeRecording(bendingArms(5), body(), config_, folder_ / "three");
  EXPECT_EQ(filesUnder(folder_ / "one"), filesUnder(folder_ / "three"));
  config_.noise = false;
  synthesizeRecording(bendingArms(1), body(), config_, folder_ / "seed1");
  config_.seed = 2;
  synthesizeRecording(bendingArms(1), body(), config_, folder_ / "seed2");
  EXPECT_NE(readBytes(folder_ / "seed1/depth/000000.png"), readBytes(folder_ / "seed2/depth/000000.png"));
}

TEST_F(Synthesize, NobodyIsInTheTruthOfAnEmptyRoom) {
  config_.scene = SceneKind::Empty;
  synthesizeRecording(bendingArms(2), body(), config_, folder_ / "rec");
  const std::vector<JointsRow> joints = readJointsFile(folder_ / "rec/truth/joints.csv");
  ASSERT_EQ(joints.size(), 2U);
  for (const JointsRow& row : joints) EXPECT_EQ(row.state, TrackState::Lost);
  EXPECT_TRUE(readPoseFile(folder_ / "rec/truth/pose.csv").empty());
  PartImage labels;
  readPng8(folder_ / "rec/truth/labels/000001.png", config_.camera.width, config_.camera.height, labels);
  for (const std::uint8_t label : labels.data) ASSERT_EQ(label, 0);
  DepthFrame frame;
  openRecording(folder_ / "rec")->read(1, frame);
  EXPECT_GT(std::ranges::count_if(frame.depth.data, [](float z) { return z > 0; }), 320 * 240 / 2);
}

TEST_F(Synthesize, EachPersonHasLabelsAndJointsOfTheirOwn) {
  config_.noise = false;
  config_.others.push_back({bendingArms(2), body(), {}, 0, 0.8});
  config_.others.push_back({bendingArms(2), body(), {}, -0.9});
  synthesizeRecording(bendingArms(3), body(), config_, folder_ / "rec");
  const JointsRow first = readJointsFile(folder_ / "rec/truth/joints.csv").back();
  const std::vector<JointsRow> second = readJointsFile(folder_ / "rec/truth/joints-2.csv");
  ASSERT_EQ(second.size(), 3U);
  EXPECT_EQ(readPoseFile(folder_ / "rec/truth/pose-2.csv").size(), 3U);
  const auto pelvis = static_cast<int>(Joint::Pelvis);
  EXPECT_GT((first.p_camera.col(pelvis) - second.back().p_camera.col(pelvis)).norm(), 0.79);
  PartImage labels;
  readPng8(folder_ / "rec/truth/labels/000002.png", config_.camera.width, config_.camera.height, labels);
  const auto labelAt = [&](const JointsRow& row, Joint joint) {
    const Eigen::Vector2d uv = config_.camera.project(row.p_camera.col(static_cast<int>(joint)));
    return static_cast<int>(labels.at(static_cast<int>(uv.x()), static_cast<int>(uv.y())));
  };
  EXPECT_EQ(labelAt(first, Joint::Spine), static_cast<int>(Part::Torso));
  EXPECT_EQ(labelAt(second.back(), Joint::Spine), 16 + static_cast<int>(Part::Torso));
  const JointsRow third = readJointsFile(folder_ / "rec/truth/joints-3.csv").back();
  EXPECT_NEAR(third.p_camera(0, pelvis), first.p_camera(0, pelvis) - 0.9, 0.01);
  EXPECT_EQ(labelAt(third, Joint::Spine), 32 + static_cast<int>(Part::Torso));
}

TEST_F(Synthesize, RefusesMorePeopleThanLabelsTell) {
  for (int i = 0; i < 6; ++i) config_.others.push_back({bendingArms(1), body(), {}});
  EXPECT_THROW(synthesizeRecording(bendingArms(1), body(), config_, folder_ / "rec"), Error);
}

}  // namespace
}  // namespace depthmocap
