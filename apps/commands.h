#pragma once

namespace CLI {
class App;
}

// Each adds one command to the program. Its callback does the work: results to stdout or files, Error on failure.
namespace depthmocap {

void addBodyTemplatesCommand(CLI::App& app);
void addCalibrateCommand(CLI::App& app);
void addCamerasCommand(CLI::App& app);
void addConfigTableCommand(CLI::App& app);
void addEvaluateCommand(CLI::App& app);
void addForestCommand(CLI::App& app);
void addRoomsCommand(CLI::App& app);
void addIkCommand(CLI::App& app);
void addLiveCommand(CLI::App& app);
void addMotionCommand(CLI::App& app);
void addPosedbCommand(CLI::App& app);
void addRecordCommand(CLI::App& app);
void addRepairCommand(CLI::App& app);
void addReplayCommand(CLI::App& app);
void addShapeSpaceCommand(CLI::App& app);
void addServeCommand(CLI::App& app);
void addSynthesizeCommand(CLI::App& app);

}  // namespace depthmocap
