#include "apps/program/learning.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string>

#include <unistd.h>

#include "depthmocap/error.h"
#include "libtracker/core/shipped_files.h"

namespace depthmocap {

bool isLearningCommand(std::string_view name) {
  return std::any_of(kLearningCommands.begin(), kLearningCommands.end(),
                     [name](const LearningCommand& command) { return name == command.name; });
}

void becomeLearningProgram(char** argv) {
  const std::string path = programFolder() / kLearningProgram;
  execv(path.c_str(), argv);
  throw Error(std::string("cannot be started: ") + std::strerror(errno), path,
              "this command is part of it; it lies beside depthmocap where all was built or installed");
}

}  // namespace depthmocap
