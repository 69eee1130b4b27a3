#pragma once

namespace CLI {
class App;
}

namespace depthmocap {

// ik evaluate: the experiment of docs/lab/ik.md.
void addIkEvaluateCommand(CLI::App& ik);

}  // namespace depthmocap
