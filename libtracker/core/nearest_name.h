#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace depthmocap {

// The name that `wrong` was most likely meant to be: the fewest edits (Levenshtein distance), the first of equals.
// `names` must not be empty.
std::string nearestName(std::string_view wrong, const std::vector<std::string>& names);

}  // namespace depthmocap
