#include "libtracker/recording/track_files.h"

#include <gtest/gtest.h>

#include "libtracker/core/error.h"
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
