#pragma once
#include <functional>

namespace CLI {
class App;
}

namespace depthmocap {

// A program of commands: reads its arguments, runs the command that they name and says what went wrong; all that main()
// has to do. Returns the exit code.
int runProgram(int argc, char** argv, const std::function<void(CLI::App&)>& add_commands);

}  // namespace depthmocap
