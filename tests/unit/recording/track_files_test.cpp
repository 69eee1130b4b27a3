#include "libtracker/recording/track_files.h"

#include <Eigen/Geometry>
#include <cstdio>
#include <fstream>

#include <gtest/gtest.h>

#include "depthmocap/error.h"
#include "depthmocap/world_frame.h"
#include "tests/support/temporary_folder.h"

namespace depthmocap {
namespace {

std::filesystem::path fixture(const std::string& name) {
  return testData("tracks") / (name + ".csv");
}

JointsRow trackedRow(std::int64_t frame) {
  JointsRow row;
  row.frame = frame;
  row.time_s = static_cast<double>(frame) / 32;
  row.state = TrackState::Tracking;
  row.p_camera.setConstant(0.25);
  row.confidence.setConstant(0.5);
  return row;
}

TEST(JointsFile, ReadsTheGoldenFile) {
  const auto rows = readJointsFile(fixture("joints_good"));
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0].state, TrackState::Tracking);
  EXPECT_EQ(rows[1].state, TrackState::Lost);
  EXPECT_TRUE(rows[1].p_camera.isZero());
  EXPECT_TRUE(rows[1].confidence.isZero());
  EXPECT_EQ(rows[2].state, TrackState::Coasting);
  EXPECT_EQ(rows[2].frame, 2);
  EXPECT_EQ(rows[2].time_s, 0.066667);
  EXPECT_EQ(rows[2].p_camera.col(3), Eigen::Vector3d(0.3, -0.15, 2.02));
  EXPECT_EQ(rows[2].confidence[3], 0.15);
}

TEST(JointsFile, ToleratesMoreColumnsAndComments) {
  EXPECT_EQ(readJointsFile(fixture("joints_more_columns")).size(), 3U);
}

TEST(JointsFile, WritesTheGoldenFileByteForByte) {
  const TemporaryFolder folder;
  JointsWriter writer(folder / "joints.csv");
  for (const JointsRow& row : readJointsFile(fixture("joints_good"))) writer.write(row);
  writer.finish();
  EXPECT_EQ(readBytes(folder / "joints.csv"), readBytes(fixture("joints_good")));
}

TEST(JointsFile, OfSeveralPeopleHasALastColumnAndTheRowsOfOneAreRead) {
  const TemporaryFolder folder;
  JointsWriter writer(folder / "joints.csv", FileOf::People);
  for (std::int64_t frame = 0; frame < 3; ++frame) {
    for (int person = 1; person <= 2; ++person) {
      JointsRow row = trackedRow(frame);
      row.person = person;
      row.p_camera.setConstant(person);
      if (frame != 1) writer.write(row);
    }
    JointsRow nobody = trackedRow(frame);
    nobody.state = TrackState::Lost;
    if (frame == 1) writer.write(nobody);
  }
  writer.finish();
  const std::string text = readBytes(folder / "joints.csv");
  EXPECT_NE(text.find("right_toe_c,person\n"), std::string::npos);
  EXPECT_NE(text.find(",0.500,2\n"), std::string::npos);
  EXPECT_NE(text.find(",,,,0,\n"), std::string::npos) << "nobody has no number";
  for (int person = 1; person <= 2; ++person) {
    const auto rows = readJointsFile(folder / "joints.csv", person);
    ASSERT_EQ(rows.size(), 2U);
    EXPECT_EQ(rows[1].frame, 2);
    EXPECT_EQ(rows[1].p_camera(0, 0), person);
  }
}

TEST(JointsFile, SaysFileLineAndReasonOfDamage) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"joints_wrong_header", "'left_elbow_x'"},
      {"joints_short_row", "line 3: has"},
      {"joints_no_number", "line 2: spine_x must be"},
      {"joints_empty_coordinate", "line 2: spine_x must be"},
      {"joints_unknown_state", "line 2: state"},
      {"joints_large_confidence", "line 2: a confidence"},
      {"joints_frames_out_of_order", "line 3: frame"},
      {"joints_empty", "is empty"},
      {"joints_missing", "No such file"}};
  for (const auto& [name, says] : cases) {
    const std::string message = errorOf([&, &file = name] { readJointsFile(fixture(file)); });
    EXPECT_NE(message.find(says), std::string::npos) << name << ": " << message;
    EXPECT_NE(message.find(name), std::string::npos) << "the file is not named: " << message;
  }
}

TEST(JointsFile, IsKeptWhenTheWorkBreaksOffAfterARow) {
  const TemporaryFolder folder;
  {
    JointsWriter writer(folder / "joints.csv");
    writer.write(trackedRow(0));
    EXPECT_FALSE(std::filesystem::exists(folder / "joints.csv"));
  }
  EXPECT_EQ(readJointsFile(folder / "joints.csv").size(), 1U);
}

TEST(JointsFile, IsNotMadeWhenTheWorkBreaksOffBeforeTheFirstRow) {
  const TemporaryFolder folder;
  { const JointsWriter writer(folder / "joints.csv"); }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(PoseFile, NamesItsWorldFrameFirstAndGivesBackThePose) {
  const TemporaryFolder folder;
  PoseRow row;
  row.frame = 4;
  row.time_s = 0.5;
  for (int i = 0; i < kDofCount; ++i) row.q[i] = 0.125 * i - 1;
  PoseWriter writer(folder / "pose.csv");
  writer.write(row);
  writer.finish();
  EXPECT_EQ(readBytes(folder / "pose.csv").rfind("# world frame: y up", 0), 0U);
  const auto rows = readPoseFile(folder / "pose.csv");
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].frame, 4);
  EXPECT_EQ(rows[0].time_s, 0.5);
  EXPECT_EQ(rows[0].q, row.q);
}

// The rotation that a comment line names: p_camera = (a x + b y + c z, ...).
Eigen::Matrix3d namedRotation(const std::string& comment) {
  Eigen::Matrix3d R_camera_world;
  const char* text = comment.c_str() + comment.find("p_camera = (") + 12;
  auto& R = R_camera_world;
  EXPECT_EQ(std::sscanf(text, "%lf x %lf y %lf z, %lf x %lf y %lf z, %lf x %lf y %lf z)", &R(0, 0), &R(0, 1), &R(0, 2),
                        &R(1, 0), &R(1, 1), &R(1, 2), &R(2, 0), &R(2, 1), &R(2, 2)),
            9)
      << comment;
  return R_camera_world;
}

TEST(PoseFile, NamesTheWorldOfATiltedCameraAndEveryNewOne) {
  const TemporaryFolder folder;
  PoseWriter writer(folder / "pose.csv");
  PoseRow row;
  const Eigen::Matrix3d tilted =
      Eigen::AngleAxisd(-0.3, Eigen::Vector3d::UnitX()).toRotationMatrix() * uprightWorldFromCamera();
  row.R_world_camera = tilted;
  writer.write(row);
  for (int i = 1; i < 3; ++i) {
    row.frame = i;
    row.time_s = i;
    row.R_world_camera = uprightWorldFromCamera();
    writer.write(row);
  }
  writer.finish();
  std::ifstream file(folder / "pose.csv");
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  ASSERT_EQ(lines.size(), 6U) << "world, header, row, world, row, row";
  EXPECT_TRUE(namedRotation(lines[0]).isApprox(tilted.transpose(), 1e-6)) << lines[0];
  EXPECT_EQ(lines[1].rfind("frame,", 0), 0U);
  EXPECT_NE(lines[3].find("p_camera = (x, -y, -z)"), std::string::npos) << lines[3];
  EXPECT_EQ(readPoseFile(folder / "pose.csv").size(), 3U);
}

TEST(PoseFile, WithoutARowStillNamesItsWorld) {
  const TemporaryFolder folder;
  PoseWriter writer(folder / "pose.csv");
  writer.finish();
  EXPECT_EQ(readBytes(folder / "pose.csv").rfind("# world frame: y up", 0), 0U);
  EXPECT_TRUE(readPoseFile(folder / "pose.csv").empty());
}

TEST(PoseFile, WritesTheGoldenFileByteForByte) {
  const TemporaryFolder folder;
  PoseWriter writer(folder / "pose.csv");
  for (const PoseRow& row : readPoseFile(fixture("pose_good"))) writer.write(row);
  writer.finish();
  EXPECT_EQ(readBytes(folder / "pose.csv"), readBytes(fixture("pose_good")));
}

TEST(PoseFile, SaysFileLineAndReasonOfDamage) {
  const std::vector<std::pair<std::string, std::string>> cases = {{"pose_wrong_header", "'upperback_ry'"},
                                                                  {"pose_short_row", "line 3: has 37 fields"},
                                                                  {"pose_infinite", "line 3: root_rz must be"}};
  for (const auto& [name, says] : cases) {
    const std::string message = errorOf([&, &file = name] { readPoseFile(fixture(file)); });
    EXPECT_NE(message.find(says), std::string::npos) << name << ": " << message;
  }
}

}  // namespace
}  // namespace depthmocap
