#pragma once
#include <cstdlib>
#include <string>

#include <sys/wait.h>

#include "tests/support/temporary_folder.h"

namespace depthmocap {

struct ProgramResult {
  int exit_code = -1;  // -1: ended by a signal
  std::string output;  // stdout
  std::string errors;  // stderr
};

// A path as one word of a shell's command line.
inline std::string quoted(const std::filesystem::path& path) {
  std::string word = "'";
  return word.append(path.string()).append("'");
}

// Runs the built program, or another one, with arguments as a shell takes them.
inline ProgramResult runProgram(const std::string& arguments, const std::string& program = DEPTHMOCAP_PROGRAM) {
  const TemporaryFolder folder;
  const std::string command = "\"" + program + "\" " + arguments + " >'" + (folder / "out").string() + "' 2>'" +
                              (folder / "err").string() + "' </dev/null";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, readBytes(folder / "out"), readBytes(folder / "err")};
}

}  // namespace depthmocap
