#include <gtest/gtest.h>

#include "tests/support/run_program.h"

namespace depthmocap {
namespace {

constexpr const char* kSmallTraining =
    " forest train --trees 1 --depth 8 --images 24 --pixels 200 --candidates 20 --validation-images 2 --procedural"
    " --bodies 2 --threads 1 --out ";

TEST(ForestTrain, MpiRanksMakeTheSameForestAsOneProcess) {
  const TemporaryFolder folder;
  const ProgramResult alone = runProgram(kSmallTraining + quoted(folder / "one.forest"));
  ASSERT_EQ(alone.exit_code, 0) << alone.errors;
  const std::string command = "mpirun --allow-run-as-root --oversubscribe -n 2 \"" DEPTHMOCAP_PROGRAM "\"" +
                              (kSmallTraining + quoted(folder / "two.forest")) + " >'" + (folder / "out").string() +
                              "' 2>'" + (folder / "err").string() + "'";
  ASSERT_EQ(std::system(command.c_str()), 0) << readBytes(folder / "err");
  const std::string forest = readBytes(folder / "one.forest");
  ASSERT_GT(forest.size(), 1000U);
  EXPECT_EQ(forest, readBytes(folder / "two.forest"));
  // Only the first rank speaks.
  const std::string errors = readBytes(folder / "err");
  EXPECT_EQ(errors.find("data: "), errors.rfind("data: "));
}

}  // namespace
}  // namespace depthmocap
