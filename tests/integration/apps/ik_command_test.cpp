#include <algorithm>

#include <gtest/gtest.h>

#include "libtracker/core/csv.h"
#include "tests/support/run_program.h"

namespace depthmocap {
namespace {

class IkCommand : public testing::Test {
 protected:
  [[nodiscard]] ProgramResult ik(const std::string& targets, const std::string& options = "") const {
    return runProgram("ik --targets " + quoted(testData("ik/" + targets + ".csv")) + " --out " +
                      quoted(folder_ / "p.csv") + " " + options);
  }
  [[nodiscard]] std::string poses() const { return readBytes(folder_ / "p.csv"); }
  TemporaryFolder folder_;
};

TEST_F(IkCommand, SolvesWithEachPriorAndSolver) {
  for (const char* options : {"", "--prior none", "--prior ppca", "--prior gmm", "--prior autoencoder", "--prior vae",
                              "--solver jacobian", "--solver ccd", "--solver fabrik", "--solver ccd --prior none"}) {
    std::filesystem::remove(folder_ / "p.csv");
    const ProgramResult result = ik("targets_good", options);
    ASSERT_EQ(result.exit_code, 0) << options << result.errors;
    EXPECT_EQ(result.output, "");
    CsvReader csv(folder_ / "p.csv");
    csv.readHeader({"pose_id", "time_s", "state", "pelvis_x"});
    ASSERT_TRUE(csv.next());
    EXPECT_EQ(csv.field(0), "1");
    const std::size_t left_wrist = 3 + 4 * 6;
    EXPECT_NEAR(csv.number(left_wrist), 0.5, 0.05) << options;
    EXPECT_NEAR(csv.number(left_wrist + 1), 1.2, 0.05) << options;
    ASSERT_TRUE(csv.next());
    EXPECT_EQ(csv.field(0), "reach_up");
    EXPECT_FALSE(csv.next());
  }
}

TEST_F(IkCommand, WritesTheSameBytesForAnyNumberOfThreads) {
  ASSERT_EQ(ik("targets_good", "--threads 1").exit_code, 0);
  const std::string one = poses();
  ASSERT_EQ(ik("targets_good", "--threads 3").exit_code, 0);
  EXPECT_EQ(poses(), one);
}

TEST_F(IkCommand, RefusesBadTargetsInOneLineAndWritesNothing) {
  for (const char* name : {"targets_none", "targets_unknown_joint", "targets_millimetres"}) {
    const ProgramResult result = ik(name);
    EXPECT_EQ(result.exit_code, 1) << name;
    EXPECT_EQ(std::count(result.errors.begin(), result.errors.end(), '\n'), 1) << result.errors;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "p.csv"));
  }
}

TEST_F(IkCommand, AnswersWrongUsageWithExitCode2) {
  for (const char* options : {"--prior dream", "--solver newton", "--solver ccd --prior vae", "--threads 0"}) {
    EXPECT_EQ(ik("targets_good", options).exit_code, 2) << options;
  }
  EXPECT_EQ(runProgram("ik").exit_code, 2);
  EXPECT_EQ(runProgram("ik evaluate").exit_code, 2);
}

}  // namespace
}  // namespace depthmocap
