#include "apps/program/learning.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string>
#include <system_error>

#include <unistd.h>

#include "depthmocap/error.h"

namespace depthmocap {

bool isLearningCommand(std::string_view name) {
  return std::any_of(kLearningCommands.begin(), kLearningCommands.end(),
                     [name](const LearningCommand& command) { return name == command.name; });
}

void becomeLearningProgram(char** argv) {
  std::error_code ignored;
  const std::filesystem::path own = std::filesystem::read_symlink("/proc/self/exe", ignored);
  const std::string path = own.parent_path() / kLearningProgram;
  execv(path.c_str(), argv);
  throw Error(std::string("cannot be started: ") + std::strerror(errno), path,
              "this command is part of it; it lies beside depthmocap where all was built or installed");
}

}  // namespace depthmocap
