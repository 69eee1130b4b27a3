// The outputs of the bundled recordings, byte for byte. A change of these bytes is either a mistake or a deliberate
// mend, whose commit says what changed and why; scripts/renew-golden then writes the new sums.
#include <string>

#include <gtest/gtest.h>

#include "tests/support/recording_excerpt.h"
#include "tests/support/run_program.h"

namespace depthmocap {
namespace {

class Golden : public testing::TestWithParam<const char*> {};

TEST_P(Golden, OutputsAreTheSameByteForByte) {
  const TemporaryFolder folder;
  const std::string name = GetParam();
  const auto at = [&](const std::string& ending) { return quoted(folder / (name + ending)); };
  const ProgramResult replayed = runProgram("replay " + quoted(bundledRecording(name)) + " --joints " +
                                            at(".joints.csv") + " --pose " + at(".pose.csv") + " --bvh " + at(".bvh"));
  ASSERT_EQ(replayed.exit_code, 0) << replayed.errors;
  const ProgramResult checked = runProgram("-c 'cd " + folder.path().string() + " && grep " + name + " " +
                                               quoted(testData("golden/SHA256SUMS")) + " | sha256sum --check --strict'",
                                           "/bin/sh");
  EXPECT_EQ(checked.exit_code, 0) << checked.output << checked.errors
                                  << "compare with the files that the commit before writes";
}

INSTANTIATE_TEST_SUITE_P(BundledRecordings, Golden, testing::Values("walk", "squat", "boxing"),
                         [](const auto& tested) { return std::string(tested.param); });

}  // namespace
}  // namespace depthmocap
