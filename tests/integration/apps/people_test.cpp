#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "libtracker/recording/track_files.h"
#include "tests/support/run_program.h"

namespace depthmocap {
namespace {

namespace fs = std::filesystem;

// Two people in a furnished room.
void render(const fs::path& folder) {
  const ProgramResult result = runProgram(
      "synthesize --motion procedural:walk_to_and_fro --scene bystander --seed 7 --camera-height 1.2 --tilt 6 --last 7 "
      "--out " +
      quoted(folder));
  ASSERT_EQ(result.exit_code, 0) << result.errors;
}

TEST(People, HaveRowsFilesAndCountsOfTheirOwnForAnyNumberOfThreads) {
  const TemporaryFolder folder;
  render(folder / "rec");
  const auto track = [&](const std::string& name, int threads) {
    const std::string base = (folder / name).string();
    std::string command = "replay " + quoted(folder / "rec");
    command += " --people 3 --threads " + std::to_string(threads);
    command += " --joints " + quoted(fs::path(base + ".csv"));
    command += " --pose " + quoted(fs::path(base + "-pose.csv"));
    command += " --bvh " + quoted(fs::path(base + ".bvh"));
    command += " --gltf " + quoted(fs::path(base + ".glb"));
    command += " --labels " + quoted(fs::path(base + "-labels"));
    command += " --stats " + quoted(fs::path(base + ".json"));
    const ProgramResult result = runProgram(command);
    ASSERT_EQ(result.exit_code, 0) << result.errors;
  };
  track("a", 1);
  track("b", 3);
  const std::string first = (folder / "a").string();
  const std::string second = (folder / "b").string();
  for (const std::string file : {".csv", "-pose.csv", "-1.bvh", "-2.bvh", ".glb", "-labels/000004.png"}) {
    EXPECT_EQ(readBytes(first + file), readBytes(second + file)) << file;
  }
  for (int person = 1; person <= 2; ++person) {
    EXPECT_GE(readJointsFile(folder / "a.csv", person).size(), 6U) << "person " << person;
    EXPECT_GE(readPoseFile(folder / "a-pose.csv", person).size(), 6U) << "person " << person;
  }
  EXPECT_TRUE(readJointsFile(folder / "a.csv", 3).empty()) << "two are there";
  EXPECT_FALSE(fs::exists(folder / "a-3.bvh"));
  EXPECT_FALSE(fs::exists(folder / "a.bvh"));
  const auto stats = nlohmann::json::parse(readBytes(folder / "a.json"));
  EXPECT_EQ(stats.at("tracked_people").size(), 3U);
  EXPECT_EQ(stats.at("tracked_people")[2], 0);
  const ProgramResult figures = runProgram("evaluate --joints " + quoted(folder / "a.csv") + " --truth " +
                                           quoted(folder / "rec") + " --person 1");
  EXPECT_EQ(figures.exit_code, 0) << figures.errors;
}

TEST(People, OfAnImpossibleNumberAreWrongUsage) {
  for (const char* number : {"0", "7", "two"}) {
    EXPECT_EQ(runProgram("replay nowhere --people " + std::string(number)).exit_code, 2) << number;
  }
}

// Cushions on a ball on a stool, as high as somebody who stands: taken for a person until a body was asked for.
TEST(People, AreNotPilesOfThings) {
  const TemporaryFolder folder;
  const ProgramResult made = runProgram(
      "synthesize --motion procedural:walk --scene empty --camera kinect1 --seed 8009 --camera-height 1.55 --tilt 9.1 "
      "--last 9 --out " +
      quoted(folder / "rec"));
  ASSERT_EQ(made.exit_code, 0) << made.errors;
  const ProgramResult tracked =
      runProgram("replay " + quoted(folder / "rec") + " --joints " + quoted(folder / "joints.csv"));
  EXPECT_NE(tracked.errors.find("tracked 0 of 10 frames"), std::string::npos) << tracked.errors;
}

}  // namespace
}  // namespace depthmocap
