#include "apps/program/program.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <csignal>
#include <iostream>
#include <new>
#include <string>

#include "depthmocap/error.h"
#include "libtracker/core/parse_number.h"
#include "libtracker/core/printable.h"

namespace depthmocap {
namespace {

// Exit codes of the program.
constexpr int kDone = 0;
constexpr int kFailed = 1;
constexpr int kWrongUsage = 2;

int failure(const std::string& message) {
  constexpr std::size_t kMostBytes = 4000;  // a path has at most 4096, an error of ours two or three hundred more
  std::cerr << "depthmocap: " << printable(message, kMostBytes) << std::endl;
  return kFailed;
}

// CLI11's ranges let NaN pass, and some options have no upper limit. Goes through all commands.
void allowOnlyFiniteNumbers(CLI::App& app) {
  for (CLI::Option* option : app.get_options()) {
    if (!option->get_type_name().starts_with("FLOAT")) continue;
    option->check([](const std::string& text) {
      const auto number = parseDouble(text);
      constexpr double kLargest = 1e9;  // far above any option's sense, far below where sums lose it
      return number && std::abs(*number) <= kLargest ? "" : "must be a number between -1e9 and 1e9";
    });
  }
  for (CLI::App* command : app.get_subcommands(nullptr)) allowOnlyFiniteNumbers(*command);
}

// CLI11 says only "A subcommand is required" to a misspelt command.
bool isUnknownCommand(const CLI::App& app, int argc, char** argv) {
  return app.get_subcommands().empty() && argc > 1 && argv[1][0] != '-';
}

int run(int argc, char** argv, const std::function<void(CLI::App&)>& add_commands) {
  CLI::App app{"Real-time body tracking from one depth camera.", "depthmocap"};
  app.set_version_flag("--version", "depthmocap " DEPTHMOCAP_VERSION);
  app.require_subcommand(1);
  app.footer("depthmocap <command> --help explains a command.");
  add_commands(app);
  allowOnlyFiniteNumbers(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& asked) {
    if (isUnknownCommand(app, argc, argv)) {
      std::cerr << "depthmocap: there is no command '" << argv[1] << "' (see depthmocap --help)\n";
      return kWrongUsage;
    }
    if (app.exit(asked) != 0) return kWrongUsage;  // otherwise --help or --version, which it has printed
  }
  std::cout.flush();
  if (!std::cout) throw Error("cannot be written", "standard output");
  return kDone;
}

}  // namespace

int runProgram(int argc, char** argv, const std::function<void(CLI::App&)>& add_commands) {
  // A reader that is gone and a file that may not grow are errors of writing, which are reported.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  try {
    return run(argc, argv, add_commands);
  } catch (const std::bad_alloc&) {
    return failure("out of memory");
  } catch (const std::exception& error) {
    return failure(error.what());
  }
}

}  // namespace depthmocap
