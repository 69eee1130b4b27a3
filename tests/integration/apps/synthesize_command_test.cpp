#include <gtest/gtest.h>

#include "libtracker/recording/recording.h"
#include "libtracker/recording/track_files.h"
#include "tests/support/run_program.h"

namespace depthmocap {
namespace {

class SynthesizeCommand : public testing::Test {
 protected:
  [[nodiscard]] ProgramResult synthesize(const std::string& name, const std::string& options) const {
    return runProgram("synthesize --out '" + (folder_ / name).string() + "' " + options);
  }
  TemporaryFolder folder_;
};

TEST_F(SynthesizeCommand, WritesARecordingThatOpens) {
  const ProgramResult result = synthesize(
      "rec", "--motion procedural:squat --first 10 --last 12 --sex f --height 1.6 --weight 55 --camera kinect2");
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  const auto recording = openRecording(folder_ / "rec");
  EXPECT_EQ(recording->frameCount(), 3U);
  EXPECT_EQ(recording->info().camera.width, 512);
  EXPECT_EQ(readJointsFile(folder_ / "rec/truth/joints.csv").size(), 3U);
  EXPECT_EQ(readPoseFile(folder_ / "rec/truth/pose.csv").size(), 3U);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "rec/truth/labels/000002.png"));
}

TEST_F(SynthesizeCommand, SameBytesForAnyNumberOfThreads) {
  const std::string options = "--motion procedural:walk --last 8 --size 320x240 --scene room --yaw 30 ";
  ASSERT_EQ(synthesize("one", options + "--threads 1").exit_code, 0);
  ASSERT_EQ(synthesize("two", options + "--threads 2").exit_code, 0);
  for (const char* file : {"depth/000000.png", "depth/000008.png", "truth/labels/000005.png", "truth/joints.csv",
                           "truth/pose.csv", "frames.csv", "recording.json"}) {
    EXPECT_EQ(readBytes(folder_ / "one" / file), readBytes(folder_ / "two" / file)) << file;
    EXPECT_FALSE(readBytes(folder_ / "one" / file).empty()) << file;
  }
}

TEST_F(SynthesizeCommand, EveryCameraAndEverySceneRenders) {
  for (const char* camera : {"d435", "d435_raw", "d435_hd", "d435_portrait", "orbbec", "azure"}) {
    const ProgramResult result =
        synthesize(camera, std::string("--motion procedural:sit_and_talk --last 0 --scene sofa --camera ") + camera);
    ASSERT_EQ(result.exit_code, 0) << camera << result.errors;
    EXPECT_EQ(openRecording(folder_ / camera)->info().camera_name, camera);
  }
  for (const char* scene : {"bed", "chair", "table", "behind_sofa", "cluttered", "corner", "empty", "bystander"}) {
    const ProgramResult result = synthesize(
        scene,
        std::string("--motion procedural:walk --last 1 --camera-height 2.2 --tilt 35 --size 320x240 --scene ") + scene);
    ASSERT_EQ(result.exit_code, 0) << scene << result.errors;
  }
  EXPECT_TRUE(std::filesystem::exists(folder_ / "bystander/truth/joints-2.csv"));
}

TEST_F(SynthesizeCommand, ListsItsMotions) {
  const ProgramResult listed = runProgram("synthesize --list-motions");
  EXPECT_EQ(listed.exit_code, 0) << listed.errors;
  EXPECT_NE(listed.output.find("procedural:squat\n"), std::string::npos) << listed.output;
}

TEST_F(SynthesizeCommand, WrongUsageExitsWithTwo) {
  EXPECT_EQ(synthesize("rec", "").exit_code, 2);
  EXPECT_EQ(synthesize("rec", "--motion procedural:walk --camera kinect3").exit_code, 2);
  EXPECT_EQ(synthesize("rec", "--motion procedural:walk --camera kinect2 --size 320x240").exit_code, 2);
  EXPECT_EQ(synthesize("rec", "--motion procedural:walk --sex x").exit_code, 2);
  EXPECT_EQ(synthesize("rec", "--motion procedural:walk --scene kitchen").exit_code, 2);
}

TEST_F(SynthesizeCommand, WorkThatFailsExitsWithOneAndSaysWhy) {
  const ProgramResult unknown = synthesize("rec", "--motion procedural:wolk");
  EXPECT_EQ(unknown.exit_code, 1);
  EXPECT_NE(unknown.errors.find("wolk"), std::string::npos);
  const ProgramResult no_frames = synthesize("rec", "--motion procedural:walk --first 5000");
  EXPECT_EQ(no_frames.exit_code, 1);
  EXPECT_NE(no_frames.errors.find("--first 5000"), std::string::npos);
  EXPECT_EQ(synthesize("rec", "--motion missing.bvh").exit_code, 1);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "rec"));
}

}  // namespace
}  // namespace depthmocap
