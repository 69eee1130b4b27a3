#include <CLI/CLI.hpp>
#include <iostream>

#include "apps/commands.h"
#include "libtracker/tracker/config_file.h"

namespace depthmocap {

void addConfigTableCommand(CLI::App& app) {
  CLI::App* command = app.add_subcommand("config-table", "Prints the sections of docs/reference/config.md.");
  command->group("");  // for developers: not in --help
  command->callback([] { std::cout << configTable(); });
}

}  // namespace depthmocap
