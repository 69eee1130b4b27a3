#include <algorithm>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "depthmocap/parts.h"
#include "libtracker/recording/png_file.h"
#include "libtracker/recording/recording.h"
#include "libtracker/recording/track_files.h"
#include "tests/support/recording_excerpt.h"
#include "tests/support/run_program.h"

namespace depthmocap {
namespace {

using nlohmann::json;

// Replays bundled recordings into a folder.
class ReplayCommand : public testing::Test {
 protected:
  [[nodiscard]] std::string at(const std::string& name) const { return quoted(folder_ / name); }
  [[nodiscard]] ProgramResult replay(const std::string& recording, const std::string& options) const {
    return runProgram("replay " + quoted(bundledRecording(recording)) + " " + options);
  }
  // Joints, pose and BVH as files name.csv, name_q.csv, name.bvh.
  void replayTo(const std::string& name, const std::string& recording, const std::string& options) const {
    const ProgramResult result = replay(recording, "--joints " + at(name + ".csv") + " --pose " + at(name + "_q.csv") +
                                                       " --bvh " + at(name + ".bvh") + " " + options);
    ASSERT_EQ(result.exit_code, 0) << result.errors;
  }
  void expectSameFiles(const std::string& a, const std::string& b) const {
    for (const char* end : {".csv", "_q.csv", ".bvh"}) {
      EXPECT_FALSE(readBytes(folder_ / (a + end)).empty()) << a << end;
      EXPECT_EQ(readBytes(folder_ / (a + end)), readBytes(folder_ / (b + end))) << a << " and " << b << end;
    }
  }
  TemporaryFolder folder_;
};

std::vector<std::string> linesOf(const std::filesystem::path& path) {
  std::vector<std::string> lines;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  return lines;
}

std::string jointsHeader() {
  std::string header = "frame,time_s,state";
  std::istringstream joints(
      "pelvis spine neck head left_shoulder left_elbow left_wrist right_shoulder right_elbow right_wrist left_hip "
      "left_knee left_ankle left_toe right_hip right_knee right_ankle right_toe");
  for (std::string joint; joints >> joint;) {
    for (const char* end : {"_x", "_y", "_z", "_c"}) header += "," + joint + end;
  }
  return header;
}

TEST_F(ReplayCommand, WritesEveryOutput) {
  const int frames = 15;
  const ProgramResult result =
      replay("walk", "--last 14 --joints " + at("j.csv") + " --pose " + at("q.csv") + " --bvh " + at("m.bvh") +
                         " --labels " + at("labels") + " --preview " + at("v.mp4") + " --contact-sheet " +
                         at("sheet.png") + " --stats " + at("s.json"));
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_EQ(result.output, "");

  const auto joints = linesOf(folder_ / "j.csv");
  ASSERT_EQ(joints.size(), frames + 1U);
  EXPECT_EQ(joints[0], jointsHeader());
  const auto rows = readJointsFile(folder_ / "j.csv");
  EXPECT_EQ(rows.back().frame, frames - 1);
  EXPECT_EQ(rows.back().state, TrackState::Tracking);

  const auto pose = linesOf(folder_ / "q.csv");
  ASSERT_GE(pose.size(), 2U);
  EXPECT_EQ(pose[0].rfind("# world frame", 0), 0U) << pose[0];
  EXPECT_EQ(pose[1].rfind("frame,time_s,root_tx,root_ty,root_tz,root_rx,root_ry,root_rz,upperback_rx", 0), 0U);
  EXPECT_EQ(std::count(pose[1].begin(), pose[1].end(), ','), kDofCount + 1);

  const std::string bvh = readBytes(folder_ / "m.bvh");
  const std::size_t count_at = bvh.find("Frames:");
  ASSERT_NE(count_at, std::string::npos);
  EXPECT_EQ(std::stoi(bvh.substr(count_at + 7, 20)), frames);
  Image<std::uint8_t> labels;
  readPng8(folder_ / "labels" / framePng(frames - 1), 640, 480, labels);
  EXPECT_GT(std::count_if(labels.data.begin(), labels.data.end(), [](int part) { return part > 0; }), 1000);
  EXPECT_LE(*std::max_element(labels.data.begin(), labels.data.end()), kPartCount);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_ / "labels"), {}), frames);
  EXPECT_EQ(readBytes(folder_ / "v.mp4").substr(4, 4), "ftyp");
  EXPECT_EQ(readBytes(folder_ / "sheet.png").substr(1, 3), "PNG");

  const json stats = json::parse(readBytes(folder_ / "s.json"));
  EXPECT_EQ(stats["frames"], frames);
  EXPECT_GE(stats["tracked"], frames - 3);
  for (const char* key : {"lost", "reinitialised", "wall_s", "peak_rss_mb", "version"})
    EXPECT_TRUE(stats.contains(key));
  for (const char* stage : {"segment", "classify", "markers", "prior", "solve", "total", "read", "write"}) {
    for (const char* figure : {"p50", "p95", "p99", "mean"}) EXPECT_GT(stats["stage_ms"][stage][figure], 0) << stage;
  }
}

TEST_F(ReplayCommand, SameBytesForAnyNumberOfThreadsAndAnyRun) {
  replayTo("one", "boxing", "--last 24 --threads 1");
  replayTo("two", "boxing", "--last 24 --threads 2");
  replayTo("again", "boxing", "--last 24 --threads 2");
  expectSameFiles("one", "two");
  expectSameFiles("two", "again");
}

TEST_F(ReplayCommand, TracksFromFirstToLast) {
  replayTo("part", "squat", "--first 20 --last 24");
  const auto rows = readJointsFile(folder_ / "part.csv");
  ASSERT_EQ(rows.size(), 5U);
  EXPECT_EQ(rows.front().frame, 20);
  EXPECT_EQ(replay("squat", "--first 5000 --joints " + at("none.csv")).exit_code, 1);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "none.csv"));
}

// Sum over joints and frames of the second differences of the paths [m].
double roughness(const std::vector<JointsRow>& rows) {
  double sum = 0;
  for (std::size_t i = 2; i < rows.size(); ++i) {
    sum += (rows[i].p_camera - 2 * rows[i - 1].p_camera + rows[i - 2].p_camera).colwise().norm().sum();
  }
  return sum;
}

TEST_F(ReplayCommand, LooksAheadForCalmerPosesAndLeavesTheRestAsItIs) {
  replayTo("off", "boxing", "--last 24 --look-ahead 0 --labels " + at("off"));
  replayTo("on", "boxing", "--last 24 --labels " + at("on"));
  const auto off = readJointsFile(folder_ / "off.csv");
  const auto on = readJointsFile(folder_ / "on.csv");
  ASSERT_EQ(on.size(), off.size());
  for (std::size_t i = 0; i < on.size(); ++i) {
    EXPECT_EQ(on[i].frame, off[i].frame);
    EXPECT_EQ(on[i].time_s, off[i].time_s);
    EXPECT_EQ(on[i].state, off[i].state);
    EXPECT_EQ(on[i].confidence, off[i].confidence);
    const std::string labels = framePng(static_cast<int>(i));
    EXPECT_EQ(readBytes(folder_ / "on" / labels), readBytes(folder_ / "off" / labels)) << i;
  }
  EXPECT_LT(roughness(on), 0.6 * roughness(off));
  EXPECT_EQ(readPoseFile(folder_ / "on_q.csv").size(), readPoseFile(folder_ / "off_q.csv").size());
  EXPECT_EQ(replay("boxing", "--look-ahead -1").exit_code, 2);
}

TEST_F(ReplayCommand, ReadsOtherFilesThanThoseThatComeWithIt) {
  for (const char* option : {"--forest", "--posedb"}) {
    const ProgramResult missing = replay("walk", "--joints " + at("j.csv") + " " + option + " " + at("none"));
    EXPECT_EQ(missing.exit_code, 1) << option;
    EXPECT_NE(missing.errors.find((folder_ / "none").string()), std::string::npos) << missing.errors;
    writeBytes(folder_ / "damaged", std::string(1000, 'x'));
    const ProgramResult damaged = replay("walk", "--joints " + at("j.csv") + " " + option + " " + at("damaged"));
    EXPECT_EQ(damaged.exit_code, 1) << option;
    EXPECT_NE(damaged.errors.find((folder_ / "damaged").string()), std::string::npos) << damaged.errors;
    EXPECT_EQ(std::count(damaged.errors.begin(), damaged.errors.end(), '\n'), 1) << damaged.errors;
  }
}

TEST_F(ReplayCommand, WritesTheJointsWhereNothingWasAskedFor) {
  const std::string program = std::string("'") + DEPTHMOCAP_PROGRAM + "'";
  const std::string recording = std::filesystem::absolute(bundledRecording("walk")).string();
  const ProgramResult result =
      runProgram("-c \"cd " + at("") + " && " + program + " replay '" + recording + "/' --last 5\"", "/bin/sh");
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_NE(result.errors.find("writing the joints to walk.joints.csv"), std::string::npos) << result.errors;
  EXPECT_EQ(readJointsFile(folder_ / "walk.joints.csv").size(), 6U);
}

// A camera on its side is not found out by itself, but the last line says how to turn it.
TEST_F(ReplayCommand, SaysHowThePicturesAreTurned) {
  const auto reader = openRecording(bundledRecording("walk"), {std::nullopt, std::nullopt, 270});
  {
    RecordingWriter writer(folder_ / "turned", reader->info());
    DepthFrame frame;
    for (std::size_t i = 0; i < reader->frameCount(); i += 10) {
      reader->read(i, frame);
      writer.write(frame);
    }
  }
  const ProgramResult result = runProgram("replay " + at("turned") + " --joints " + at("j.csv"));
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_NE(result.errors.find("--turn 90"), std::string::npos) << result.errors;
}

}  // namespace
}  // namespace depthmocap
