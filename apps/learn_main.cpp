#include <CLI/CLI.hpp>

#include "apps/commands.h"
#include "apps/program/program.h"

int main(int argc, char** argv) {
  return depthmocap::runProgram(argc, argv, [](CLI::App& app) {
    depthmocap::addForestCommand(app);
    depthmocap::addRoomsCommand(app);
    depthmocap::addSynthesizeCommand(app);
  });
}
