#pragma once
#include <string>
#include <vector>

namespace depthmocap {

// To stderr, a line each, with the program's name before it.
void warn(const std::string& text);
void warn(const std::vector<std::string>& texts);

}  // namespace depthmocap
