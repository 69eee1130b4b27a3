#include <algorithm>
#include <sstream>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/run_program.h"

namespace depthmocap {
namespace {

// The names under "Subcommands:" in the help; none if there is no such list.
std::vector<std::string> commandsIn(const std::string& help) {
  std::vector<std::string> commands;
  std::istringstream lines(help);
  std::string line;
  while (std::getline(lines, line) && line != "Subcommands:") continue;
  while (std::getline(lines, line) && line.rfind("  ", 0) == 0) {
    if (line[2] != ' ') commands.push_back(line.substr(2, line.find(' ', 2) - 2));
  }
  return commands;
}

// Asks a command for its help, and each command under it; says how many there are.
int askForHelp(const std::string& command) {
  const ProgramResult result = runProgram(command + " --help");
  EXPECT_EQ(result.exit_code, 0) << command;
  EXPECT_EQ(result.errors, "") << command;
  EXPECT_NE(result.output.find("Usage: depthmocap" + command), std::string::npos) << result.output;
  int count = 1;
  for (const std::string& name : commandsIn(result.output)) count += askForHelp(command + " " + name);
  return count;
}

TEST(Program, ExplainsItselfAndEachCommand) {
  EXPECT_GE(askForHelp(""), 3);
}

TEST(Program, TellsItsVersion) {
  const ProgramResult result = runProgram("--version");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.output.rfind("depthmocap 0.", 0), 0U) << result.output;
}

TEST(Program, AnswersWrongUsageWithExitCode2AndNothingOnStdout) {
  for (const char* arguments :
       {"", "dance", "--dance", "evaluate", "evaluate --joints", "evaluate --dance",
        "evaluate --joints a --truth b --truth-pose c", "evaluate --joints a --truth b --first x"}) {
    const ProgramResult result = runProgram(arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments;
    EXPECT_EQ(result.output, "") << arguments;
    EXPECT_NE(result.errors, "") << arguments;
  }
}

TEST(Program, AnswersFailedWorkWithExitCode1AndOneLine) {
  const std::string good = testData("tracks/joints_good.csv").string();
  for (const std::string& arguments :
       {"evaluate --joints /no/such.csv --truth '" + good + "'", "evaluate --joints '" + good + "' --truth /no/such",
        "evaluate --joints '" + testData("tracks/joints_no_number.csv").string() + "' --truth '" + good + "'"}) {
    const ProgramResult result = runProgram(arguments);
    EXPECT_EQ(result.exit_code, 1) << arguments;
    EXPECT_EQ(result.output, "") << arguments;
    EXPECT_EQ(result.errors.rfind("depthmocap: ", 0), 0U) << result.errors;
    EXPECT_EQ(std::count(result.errors.begin(), result.errors.end(), '\n'), 1) << result.errors;
  }
}

}  // namespace
}  // namespace depthmocap
