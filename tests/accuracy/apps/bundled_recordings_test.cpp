#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/recording_excerpt.h"
#include "tests/support/run_program.h"

namespace depthmocap {
namespace {

using nlohmann::json;

json allLimits() {
  return json::parse(readBytes(std::filesystem::path(DEPTHMOCAP_SOURCE_DIR) / "tests/accuracy/limits.json"));
}

std::vector<std::string> names() {
  const json all = allLimits();
  std::vector<std::string> result;
  for (const auto& [name, limits] : all.items()) result.push_back(name);
  return result;
}

class BundledRecordings : public testing::TestWithParam<std::string> {};

// Each entry of tests/accuracy/limits.json: a bundled recording, tracked by the program, or, where options are given,
// by the program of the experiments.
TEST_P(BundledRecordings, AreTrackedWithinTheLimits) {
  const json limits = allLimits().at(GetParam());
  const TemporaryFolder folder;
  const std::string recording = quoted(bundledRecording(limits.at("recording").get<std::string>()));
  const std::string files = " --joints " + quoted(folder / "j.csv") + " --pose " + quoted(folder / "q.csv");
  const ProgramResult tracked =
      limits.contains("options")
          ? runProgram(recording + files + " " + limits.at("options").get<std::string>(), DEPTHMOCAP_EXPERIMENT)
          : runProgram("replay " + recording + files);
  ASSERT_EQ(tracked.exit_code, 0) << tracked.errors;
  const ProgramResult evaluated = runProgram("evaluate --truth " + recording + files);
  ASSERT_EQ(evaluated.exit_code, 0) << evaluated.errors;
  const json figures = json::parse(evaluated.output);
  for (const auto& [name, limit] : limits.at("at_most").items()) EXPECT_LE(figures.at(name), limit) << name;
  for (const auto& [name, limit] : limits.at("at_least").items()) EXPECT_GE(figures.at(name), limit) << name;
}

INSTANTIATE_TEST_SUITE_P(All, BundledRecordings, testing::ValuesIn(names()),
                         [](const auto& entry) { return entry.param; });

}  // namespace
}  // namespace depthmocap
