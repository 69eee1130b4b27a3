#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <iostream>
#include <new>
#include <string>

#include "apps/commands.h"
#include "depthmocap/error.h"

namespace depthmocap {

namespace {

// Exit codes of the program.
constexpr int kDone = 0;
constexpr int kFailed = 1;
constexpr int kWrongUsage = 2;

void addCommands(CLI::App& app) {
  addReplayCommand(app);
  addLiveCommand(app);
  addRecordCommand(app);
  addCamerasCommand(app);
  addCalibrateCommand(app);
  addEvaluateCommand(app);
#ifdef DEPTHMOCAP_LEARNING
  addForestCommand(app);
  addRoomsCommand(app);
#endif
  addPosedbCommand(app);
  addIkCommand(app);
  addShapeSpaceCommand(app);
  addBodyTemplatesCommand(app);
  addConfigTableCommand(app);
  addServeCommand(app);
#ifdef DEPTHMOCAP_LEARNING
  addSynthesizeCommand(app);
#endif
}

int failure(std::string message) {
  std::replace(message.begin(), message.end(), '\n', ' ');
  std::cerr << "depthmocap: " << message << std::endl;
  return kFailed;
}

// CLI11 says only "A subcommand is required" to a misspelt command.
bool isUnknownCommand(const CLI::App& app, int argc, char** argv) {
  return app.get_subcommands().empty() && argc > 1 && argv[1][0] != '-';
}

int run(int argc, char** argv) {
  CLI::App app{"Real-time body tracking from one depth camera.", "depthmocap"};
  app.set_version_flag("--version", "depthmocap " DEPTHMOCAP_VERSION);
  app.require_subcommand(1);
  app.footer("depthmocap <command> --help explains a command.");
  addCommands(app);
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

}  // namespace depthmocap

int main(int argc, char** argv) {
  try {
    return depthmocap::run(argc, argv);
  } catch (const std::bad_alloc&) {
    return depthmocap::failure("out of memory");
  } catch (const std::exception& error) {
    return depthmocap::failure(error.what());
  }
}
