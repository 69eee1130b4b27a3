#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "libtracker/clinical/angles_file.h"
#include "libtracker/marker_files/marker_files.h"
#include "tests/support/recording_excerpt.h"
#include "tests/support/run_program.h"
#include "tests/support/temporary_folder.h"

// Files for other programs, from a short excerpt of a bundled recording.
namespace depthmocap {
namespace {

namespace fs = std::filesystem;

class ExportTest : public testing::Test {
 protected:
  static constexpr int kFrames = 12;
  void SetUp() override { copyExcerpt("squat", kFrames, folder_ / "rec"); }
  [[nodiscard]] std::string replay(const std::string& options) const {
    return "replay " + quoted(folder_ / "rec") + " " + options;
  }
  [[nodiscard]] std::string path(const std::string& name) const { return quoted(folder_ / name); }

  const TemporaryFolder folder_;
};

// World of the joints file and the marker file differ by axes and a translation: distances between joints do not.
void expectSameShape(const MarkerSequence& markers, const std::vector<JointsRow>& joints) {
  ASSERT_EQ(markers.frames(), joints.size());
  for (std::size_t t = 0; t < joints.size(); ++t) {
    const auto column = static_cast<Eigen::Index>(t);
    for (int a = 0; a < kJointCount; ++a) {
      for (int b = 0; b < a; ++b) {
        const double expected = (joints[t].p_camera.col(a) - joints[t].p_camera.col(b)).norm();
        const auto p = [&](int j) { return markers.tracks[static_cast<std::size_t>(j)].p.col(column); };
        EXPECT_NEAR((p(a) - p(b)).norm(), expected, 2e-5);
      }
    }
  }
}

TEST_F(ExportTest, MarkersAreTheJoints) {
  const ProgramResult result =
      runProgram(replay("--joints " + path("j.csv") + " --trc " + path("m.trc") + " --c3d " + path("m.c3d")));
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  const auto joints = readJointsFile(folder_ / "j.csv");
  const MarkerSequence trc = readMarkers(folder_ / "m.trc");
  const MarkerSequence c3d = readMarkers(folder_ / "m.c3d");
  expectSameShape(trc, joints);
  expectSameShape(c3d, joints);
  EXPECT_NEAR(trc.fps, 30.0, 0.01);
  // Feet stand on the floor: y is up in TRC, z in C3D.
  const auto ankle = static_cast<std::size_t>(Joint::LeftAnkle);
  EXPECT_NEAR(trc.tracks[ankle].p(1, 5), 0.07, 0.03);
  EXPECT_NEAR(c3d.tracks[ankle].p(2, 5), trc.tracks[ankle].p(1, 5), 1e-5);
}

TEST_F(ExportTest, AnglesAreThoseOfThePoseFile) {
  const ProgramResult result = runProgram(replay("--pose " + path("q.csv") + " --angles " + path("a.csv")));
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  const auto poses = readPoseFile(folder_ / "q.csv");
  const auto rows = readAnglesFile(folder_ / "a.csv");
  ASSERT_EQ(poses.size(), rows.size());
  ClinicalAngleReader reader;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    ForwardKinematics fk;
    fk.update(makeSkeleton(BoneLengths{}), poses[i].q);
    EXPECT_LT((reader.read(fk) - rows[i].angles).cwiseAbs().maxCoeff(), 0.01);
  }
}

TEST_F(ExportTest, OpenSimHasARowForEachPose) {
  const ProgramResult result = runProgram(replay("--mot " + path("m.mot")));
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  const std::string text = readBytes(folder_ / "m.mot");
  EXPECT_NE(text.find("nRows=12\nnColumns=28\n"), std::string::npos);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 11 + kFrames);
}

TEST_F(ExportTest, SeveralPeopleHaveFilesOfTheirOwn) {
  const ProgramResult result = runProgram(
      replay("--people 2 --trc " + path("m.trc") + " --mot " + path("m.mot") + " --angles " + path("a.csv")));
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_TRUE(fs::exists(folder_ / "m-1.trc"));
  EXPECT_TRUE(fs::exists(folder_ / "m-1.mot"));
  EXPECT_FALSE(fs::exists(folder_ / "m.trc"));
  EXPECT_EQ(readAnglesFile(folder_ / "a.csv", 1).size(), static_cast<std::size_t>(kFrames));
}

TEST_F(ExportTest, AnimationsTakeNamesRateAndPlaceThatAreAskedFor) {
  const ProgramResult result = runProgram(replay("--bvh " + path("m.bvh") + " --usd " + path("m.usda") +
                                                 " --rig unreal --fps-out 60 --root-motion in-place --loop"));
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  const std::string bvh = readBytes(folder_ / "m.bvh");
  EXPECT_NE(bvh.find("ROOT root\n"), std::string::npos);
  EXPECT_NE(bvh.find("JOINT thigh_l\n"), std::string::npos);
  EXPECT_NE(bvh.find("Frames:           23\nFrame Time: 0.01666667\n"), std::string::npos);
  EXPECT_NE(readBytes(folder_ / "m.usda").find("\"root/pelvis/thigh_r/calf_r\""), std::string::npos);
  EXPECT_EQ(runProgram(replay("--bvh " + path("n.bvh") + " --rig maya")).exit_code, 2);
}

TEST_F(ExportTest, FbxIsRefusedWithTheWayAround) {
  const ProgramResult result = runProgram(replay("--fbx " + path("m.fbx")));
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.errors.find("import it in Blender and export FBX there"), std::string::npos) << result.errors;
}

TEST_F(ExportTest, AFileInAMissingFolderIsRefusedBeforeTracking) {
  for (const std::string option : {"--trc", "--c3d", "--mot", "--angles", "--usd"}) {
    const ProgramResult result = runProgram(replay(option + " " + path("no/such/file")));
    EXPECT_EQ(result.exit_code, 1) << option;
    EXPECT_EQ(result.errors.find("tracked"), std::string::npos) << option;
  }
}

TEST_F(ExportTest, AFolderOfRecordingsIsTrackedOnce) {
  fs::create_directories(folder_ / "all/second");
  fs::rename(folder_ / "rec", folder_ / "all/first");
  copyExcerpt("walk", kFrames, folder_ / "all/second/walk");
  fs::create_directories(folder_ / "all/broken");
  writeBytes(folder_ / "all/broken/recording.json", "{");
  const std::string command = "replay " + path("all") + " --out " + path("out");
  const ProgramResult first = runProgram(command);
  EXPECT_EQ(first.exit_code, 1);  // one is broken
  EXPECT_NE(first.errors.find("broken"), std::string::npos) << first.errors;
  for (const char* name : {"joints.csv", "pose.csv", "angles.csv", "motion.bvh", "stats.json"}) {
    EXPECT_TRUE(fs::exists(folder_ / "out/second/walk" / name)) << name;
  }
  const auto written = fs::last_write_time(folder_ / "out/first/stats.json");
  fs::remove_all(folder_ / "all/broken");
  const ProgramResult second = runProgram(command);
  EXPECT_EQ(second.exit_code, 0) << second.errors;
  EXPECT_EQ(fs::last_write_time(folder_ / "out/first/stats.json"), written);
  EXPECT_NE(second.output.find("second/walk"), std::string::npos);
  EXPECT_NE(readBytes(folder_ / "out/summary.csv").find("\nfirst,done before,12,"), std::string::npos);
  EXPECT_EQ(runProgram(command + " --smooth 0.5").exit_code, 1);
  EXPECT_EQ(runProgram(command + " --joints " + path("j.csv")).exit_code, 2);
}

TEST_F(ExportTest, ResultsOfAFolderAreThoseOfEachRecording) {
  ASSERT_EQ(runProgram("replay " + quoted(folder_.path()) + " --out " + path("out") + " --threads 1").exit_code, 0);
  ASSERT_EQ(runProgram(replay("--joints " + path("j.csv") + " --bvh " + path("m.bvh"))).exit_code, 0);
  EXPECT_EQ(readBytes(folder_ / "out/rec/joints.csv"), readBytes(folder_ / "j.csv"));
  EXPECT_EQ(readBytes(folder_ / "out/rec/motion.bvh"), readBytes(folder_ / "m.bvh"));
}

TEST_F(ExportTest, PlotsAnglesAndJoints) {
  ASSERT_EQ(runProgram(replay("--joints " + path("j.csv") + " --angles " + path("a.csv"))).exit_code, 0);
  for (const std::string input : {"j.csv", "a.csv"}) {
    ASSERT_EQ(runProgram("plot " + path(input) + " --out " + path(input + ".png")).exit_code, 0);
    ASSERT_EQ(runProgram("plot " + path(input) + " --out " + path(input + ".html")).exit_code, 0);
    EXPECT_EQ(readBytes(folder_ / (input + ".png")).substr(1, 3), "PNG");
    const std::string page = readBytes(folder_ / (input + ".html"));
    EXPECT_NE(page.find("<svg"), std::string::npos);
    EXPECT_NE(page.find("left_knee_flexion"), std::string::npos);
  }
  EXPECT_EQ(runProgram("plot " + path("a.csv") + " --out " + path("p.jpg")).exit_code, 2);
  const ProgramResult unknown = runProgram("plot " + path("a.csv") + " --out " + path("p.png") + " --angles nose");
  EXPECT_EQ(unknown.exit_code, 1);
  EXPECT_NE(unknown.errors.find("there is no angle 'nose'"), std::string::npos) << unknown.errors;
  EXPECT_EQ(runProgram("plot " + path("rec/frames.csv") + " --out " + path("p.png")).exit_code, 1);
}

}  // namespace
}  // namespace depthmocap
