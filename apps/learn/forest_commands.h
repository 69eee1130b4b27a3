#pragma once

namespace CLI {
class App;
}

// The parts of the forest command.
namespace depthmocap {

void addForestTrain(CLI::App& forest);
void addForestInfo(CLI::App& forest);
void addForestEvaluate(CLI::App& forest);
void addForestMarkers(CLI::App& forest);

}  // namespace depthmocap
