#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "libtracker/choreography/gait.h"
#include "libtracker/choreography/step_numbers.h"

namespace depthmocap {

// The paths that motion files know by name, and the numbers that a walk along each takes: those of the path and
// "seconds". Stairs have "rise" (of a step, < 0 down) and "tread" [m].
std::vector<std::string> walkPathNames();
// Null if there is no such path.
const NumberNames* walkNumbers(std::string_view path);

// Walks along a path of walkPathNames().
BodyFrames walkAlongNamed(std::string_view path, const Numbers& numbers, const GaitStyle& style, double first_phase);

}  // namespace depthmocap
