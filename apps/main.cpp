#include <CLI/CLI.hpp>

#include "apps/commands.h"
#include "apps/plot/plot_command.h"
#include "apps/program/learning.h"
#include "apps/program/program.h"

namespace depthmocap {
namespace {

// In the list of commands; each is answered by the other program.
void addLearningCommands(CLI::App& app, char** argv) {
#ifdef DEPTHMOCAP_LEARNING
  for (const LearningCommand& command : kLearningCommands) {
    app.add_subcommand(command.name, command.help)->callback([argv] { becomeLearningProgram(argv); });
  }
#else
  static_cast<void>(app);
  static_cast<void>(argv);
#endif
}

void addCommands(CLI::App& app, char** argv) {
  addReplayCommand(app);
  addLiveCommand(app);
  addRecordCommand(app);
  addCamerasCommand(app);
  addCalibrateCommand(app);
  addEvaluateCommand(app);
  addPlotCommand(app);
  addPosedbCommand(app);
  addMotionCommand(app);
  addIkCommand(app);
  addRepairCommand(app);
  addShapeSpaceCommand(app);
  addBodyTemplatesCommand(app);
  addConfigTableCommand(app);
  addServeCommand(app);
  addLearningCommands(app, argv);
}

}  // namespace
}  // namespace depthmocap

int main(int argc, char** argv) {
  return depthmocap::runProgram(argc, argv, [&](CLI::App& app) {
#ifdef DEPTHMOCAP_LEARNING
    // Before anything of the arguments is read: they are the other program's.
    if (argc > 1 && depthmocap::isLearningCommand(argv[1])) depthmocap::becomeLearningProgram(argv);
#endif
    depthmocap::addCommands(app, argv);
  });
}
