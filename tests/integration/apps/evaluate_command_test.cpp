#include <nlohmann/json.hpp>

#include <gtest/gtest.h>

#include "libtracker/recording/track_files.h"
#include "tests/support/run_program.h"

namespace depthmocap {
namespace {

using nlohmann::json;

// A recording's folder with truth files, and track files that differ from them by a known amount.
class EvaluateCommand : public testing::Test {
 protected:
  EvaluateCommand() {
    std::filesystem::create_directories(folder_ / "rec/truth");
    writeJoints("rec/truth/joints.csv", 0.0);
    writeJoints("joints.csv", 0.05);
    writePose("rec/truth/pose.csv", 0.0);
    writePose("pose.csv", 0.1);
  }

  void writeJoints(const std::string& name, double offset_m) {
    JointsWriter writer(folder_ / name);
    for (int frame = 0; frame < 4; ++frame) {
      JointsRow row;
      row.frame = frame;
      row.time_s = frame / 30.0;
      row.state = offset_m > 0 && frame == 3 ? TrackState::Lost : TrackState::Tracking;
      for (int joint = 0; joint < kJointCount; ++joint)
        row.p_camera.col(joint) = Eigen::Vector3d(joint + offset_m, 0, 2);
      writer.write(row);
    }
    writer.finish();
  }

  void writePose(const std::string& name, double angle) {
    PoseWriter writer(folder_ / name);
    PoseRow row;
    row.q.setConstant(angle);
    writer.write(row);
    writer.finish();
  }

  [[nodiscard]] std::string at(const std::string& name) const { return " '" + (folder_ / name).string() + "'"; }

  TemporaryFolder folder_;
};

TEST_F(EvaluateCommand, PrintsTheFiguresOfTheContract) {
  const ProgramResult result =
      runProgram("evaluate --joints" + at("joints.csv") + " --truth" + at("rec") + " --pose" + at("pose.csv"));
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  const json figures = json::parse(result.output);
  EXPECT_EQ(figures.at("frames"), 4);
  EXPECT_EQ(figures.at("compared"), 3);
  EXPECT_NEAR(figures.at("mean_joint_error_m").get<double>(), 0.05, 1e-9);
  EXPECT_NEAR(figures.at("per_joint_error_m").at("right_toe").get<double>(), 0.05, 1e-9);
  EXPECT_EQ(figures.at("map_10cm"), 0.75);
  EXPECT_EQ(figures.at("pck_10cm").at("pelvis"), 0.75);
  EXPECT_NEAR(figures.at("mean_bone_direction_error_deg").get<double>(), 0, 1e-9);
  EXPECT_NEAR(figures.at("mean_joint_angle_error_deg").get<double>(), 5.729578, 1e-5);
  EXPECT_NEAR(figures.at("per_dof_error_deg").at("upperback_rx").get<double>(), 5.729578, 1e-5);
  EXPECT_EQ(figures.at("per_dof_error_deg").size(), 33U);
  EXPECT_NEAR(figures.at("jitter_m_s2").get<double>(), 0, 1e-6);
  EXPECT_EQ(figures.at("lost_fraction"), 0.25);
}

TEST_F(EvaluateCommand, LeavesAnglesEmptyWithoutPoses) {
  const ProgramResult result =
      runProgram("evaluate --joints" + at("joints.csv") + " --truth" + at("rec/truth/joints.csv"));
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_TRUE(json::parse(result.output).at("mean_joint_angle_error_deg").is_null());
}

TEST_F(EvaluateCommand, ComparesRelativeToThePelvis) {
  const ProgramResult result =
      runProgram("evaluate --root-relative --joints" + at("joints.csv") + " --truth" + at("rec"));
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_NEAR(json::parse(result.output).at("mean_joint_error_m").get<double>(), 0, 1e-9);
}

TEST_F(EvaluateCommand, AsksForTheTruePoseWhenTheTruthIsAFile) {
  const std::string arguments =
      "evaluate --joints" + at("joints.csv") + " --truth" + at("rec/truth/joints.csv") + " --pose" + at("pose.csv");
  EXPECT_EQ(runProgram(arguments).exit_code, 2);
  EXPECT_EQ(runProgram(arguments + " --truth-pose" + at("rec/truth/pose.csv")).exit_code, 0);
}

TEST_F(EvaluateCommand, SaysWhenTheRecordingHasNoTruth) {
  std::filesystem::remove_all(folder_ / "rec/truth");
  const ProgramResult result = runProgram("evaluate --joints" + at("joints.csv") + " --truth" + at("rec"));
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_NE(result.errors.find("has no truth"), std::string::npos) << result.errors;
}

TEST_F(EvaluateCommand, ReportsThatItsOutputCannotBeWritten) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "this system has no /dev/full";
  const std::string command =
      "\"" DEPTHMOCAP_PROGRAM "\" evaluate --joints" + at("joints.csv") + " --truth" + at("rec");
  const int status = std::system((command + " >/dev/full 2>/dev/null").c_str());
  EXPECT_EQ(WEXITSTATUS(status), 1);
}

}  // namespace
}  // namespace depthmocap
