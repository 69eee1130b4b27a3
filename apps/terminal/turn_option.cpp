#include "apps/terminal/turn_option.h"

#include <CLI/CLI.hpp>

namespace depthmocap {

void addTurnOption(CLI::App& command, int& degrees) {
  command
      .add_option("--turn", degrees,
                  "A camera on its side or upside down: degrees clockwise that make its pictures upright")
      ->type_name("DEG")
      ->check(CLI::IsMember({0, 90, 180, 270}))
      ->capture_default_str();
}

}  // namespace depthmocap
