#include <CLI/CLI.hpp>

#include "apps/commands.h"
#include "apps/learn/forest_commands.h"
#include "apps/program/learning.h"

namespace depthmocap {

void addForestCommand(CLI::App& app) {
  CLI::App* forest = app.add_subcommand(kForestCommand.name, kForestCommand.help);
  forest->require_subcommand(1);
  addForestTrain(*forest);
  addForestInfo(*forest);
  addForestEvaluate(*forest);
  addForestMarkers(*forest);
}

}  // namespace depthmocap
