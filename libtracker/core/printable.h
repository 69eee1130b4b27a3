#pragma once
#include <cstddef>
#include <string>
#include <string_view>

namespace depthmocap {

// A text that others wrote, fit for one line of a message: control characters (line ends, escape sequences) as '?', and
// what goes beyond `most` bytes as "...".
std::string printable(std::string_view text, std::size_t most);

}  // namespace depthmocap
