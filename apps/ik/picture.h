#pragma once
#include <filesystem>
#include <vector>

#include "libtracker/ik/ik_experiment.h"

namespace depthmocap {

// A PNG with a row a task and a column each for the truth and for what each solver, one a prior, finds; targets are
// rings. Seen along -z from the front of the body, a little from its side and from above.
void drawIkPicture(const std::vector<IkTask>& tasks, const std::vector<IkSolver>& solvers,
                   const std::filesystem::path& path);

}  // namespace depthmocap
