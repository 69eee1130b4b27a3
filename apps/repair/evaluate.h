#pragma once

namespace CLI {
class App;
}

namespace depthmocap {

// repair evaluate: the experiment of docs/lab/repair.md.
void addRepairEvaluateCommand(CLI::App& repair);

}  // namespace depthmocap
