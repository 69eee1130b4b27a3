#pragma once
#include <string>
#include <vector>

#include "libtracker/tracker/tracker_config.h"

namespace depthmocap {

// The parts of the method that can be left out, to measure what each is worth (docs/lab/accuracy.md): the terms of
// equation (5) and what we add to the paper.
std::vector<std::string> optionalParts();

// `config` without one of them; Error names the parts that there are.
void leaveOut(const std::string& part, TrackerConfig& config);

}  // namespace depthmocap
