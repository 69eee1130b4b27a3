#pragma once

namespace CLI {
class App;
}

namespace depthmocap {

// Adds `plot` to the program, as apps/commands.h.
void addPlotCommand(CLI::App& app);

}  // namespace depthmocap
