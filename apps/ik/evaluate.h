#pragma once

namespace CLI {
class App;
}

namespace depthmocap {

// ik evaluate: the experiment of docs/ik.md.
void addIkEvaluateCommand(CLI::App& ik);

}  // namespace depthmocap
