#pragma once

namespace CLI {
class App;
}

namespace depthmocap {

// --turn, of every command that reads pictures; `degrees` keeps its value unless it is given.
void addTurnOption(CLI::App& command, int& degrees);

}  // namespace depthmocap
