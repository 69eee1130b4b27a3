#include <nlohmann/json.hpp>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/recording_excerpt.h"
#include "tests/support/run_program.h"

namespace depthmocap {
namespace {

using nlohmann::json;

class BundledRecordings : public testing::TestWithParam<const char*> {};

// The default files track each bundled recording within tests/accuracy/limits.json.
TEST_P(BundledRecordings, AreTrackedWithinTheLimits) {
  const json limits =
      json::parse(readBytes(std::filesystem::path(DEPTHMOCAP_SOURCE_DIR) / "tests/accuracy/limits.json"))
          .at(GetParam());
  const TemporaryFolder folder;
  const std::string recording = quoted(bundledRecording(GetParam()));
  const std::string files = " --joints " + quoted(folder / "j.csv") + " --pose " + quoted(folder / "q.csv");
  const ProgramResult tracked = runProgram("replay " + recording + files);
  ASSERT_EQ(tracked.exit_code, 0) << tracked.errors;
  const ProgramResult evaluated = runProgram("evaluate --truth " + recording + files);
  ASSERT_EQ(evaluated.exit_code, 0) << evaluated.errors;
  const json figures = json::parse(evaluated.output);
  for (const auto& [name, limit] : limits.at("at_most").items()) EXPECT_LE(figures.at(name), limit) << name;
  for (const auto& [name, limit] : limits.at("at_least").items()) EXPECT_GE(figures.at(name), limit) << name;
}

INSTANTIATE_TEST_SUITE_P(All, BundledRecordings, testing::Values("walk", "boxing", "squat"),
                         [](const auto& recording) { return std::string(recording.param); });

}  // namespace
}  // namespace depthmocap
