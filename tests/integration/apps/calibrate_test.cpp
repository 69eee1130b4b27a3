#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/run_program.h"

namespace depthmocap {
namespace {

std::filesystem::path bundled(const std::string& name) {
  return std::filesystem::path(DEPTHMOCAP_SOURCE_DIR) / "recordings" / name;
}

// Frames of procedural:calibrate of a man of 1.80 m at half the resolution.
void render(const std::filesystem::path& folder, int first, int last) {
  const ProgramResult result =
      runProgram("synthesize --motion procedural:calibrate --height 1.80 --weight 78 --size 320x240 --first " +
                 std::to_string(first) + " --last " + std::to_string(last) + " --out " + quoted(folder));
  ASSERT_EQ(result.exit_code, 0) << result.errors;
}

TEST(Calibrate, WritesAnActorThatReplayTakesAndKeeps) {
  const TemporaryFolder folder;
  render(folder / "rec", 55, 80);
  const std::string command = "calibrate " + quoted(folder / "rec") + " --tpose-only ";
  const ProgramResult one =
      runProgram(command + "--threads 1 --out " + quoted(folder / "a.json") + " --preview " + quoted(folder / "a.png"));
  ASSERT_EQ(one.exit_code, 0) << one.errors;
  ASSERT_EQ(runProgram(command + "--threads 3 --out " + quoted(folder / "b.json")).exit_code, 0);
  EXPECT_EQ(readBytes(folder / "a.json"), readBytes(folder / "b.json"));
  EXPECT_EQ(readBytes(folder / "a.png").substr(1, 3), "PNG");
  const auto actor = nlohmann::json::parse(readBytes(folder / "a.json"));
  EXPECT_EQ(actor.at("format"), "depthmocap-actor");
  EXPECT_NEAR(actor.at("stature_m").get<double>(), 1.80, 0.03);
  for (const char* bone : {"upper_arm", "lower_arm", "upper_leg", "lower_leg", "foot", "shoulder_width", "hip_width",
                           "torso", "neck_to_head"}) {
    EXPECT_TRUE(actor.at("bone_lengths_m").contains(bone)) << bone;
  }
  const ProgramResult replayed = runProgram("replay " + quoted(folder / "rec") + " --actor " +
                                            quoted(folder / "a.json") + " --stats " + quoted(folder / "s.json"));
  ASSERT_EQ(replayed.exit_code, 0) << replayed.errors;
  const auto stats = nlohmann::json::parse(readBytes(folder / "s.json"));
  EXPECT_NEAR(stats.at("stature_m").get<double>(), actor.at("stature_m").get<double>(), 5e-4);
}

TEST(Calibrate, AGivenHeightIsTheActors) {
  const TemporaryFolder folder;
  render(folder / "rec", 58, 70);
  const ProgramResult result = runProgram("calibrate " + quoted(folder / "rec") + " --tpose-only --height 1.70 --out " +
                                          quoted(folder / "a.json"));
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  const auto actor = nlohmann::json::parse(readBytes(folder / "a.json"));
  EXPECT_NEAR(actor.at("stature_m").get<double>(), 1.70, 1e-3);
  EXPECT_NEAR(actor.at("depth_scale").get<double>(), 1.70 / 1.80, 0.02);
}

// Exit code 1, one line that says what to do, and no file.
void expectRefused(const std::filesystem::path& recording, const std::string& reason) {
  const TemporaryFolder folder;
  const ProgramResult result = runProgram("calibrate " + quoted(recording) + " --out " + quoted(folder / "a.json") +
                                          " --preview " + quoted(folder / "a.png"));
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_NE(result.errors.find(reason), std::string::npos) << result.errors;
  EXPECT_EQ(std::count(result.errors.begin(), result.errors.end(), '\n'), 1) << result.errors;
  EXPECT_FALSE(std::filesystem::exists(folder / "a.json"));
  EXPECT_FALSE(std::filesystem::exists(folder / "a.png"));
}

TEST(Calibrate, RefusesARecordingWithoutATPose) {
  expectRefused(bundled("walk"), "show a T-pose; most often");
}

TEST(Calibrate, RefusesFiveFrames) {
  const TemporaryFolder folder;
  render(folder / "rec", 60, 64);
  expectRefused(folder / "rec", "5 frames are too few");
}

TEST(Calibrate, RefusesARecordingThatIsNotThere) {
  expectRefused("/nowhere/at/all", "/nowhere/at/all");
}

TEST(Calibrate, ReplayRefusesADamagedActor) {
  const ProgramResult result =
      runProgram("replay " + quoted(bundled("walk")) + " --last 1 --actor " + quoted(testData("actors/no_foot.json")));
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_NE(result.errors.find("\"foot\" is missing"), std::string::npos) << result.errors;
}

}  // namespace
}  // namespace depthmocap
