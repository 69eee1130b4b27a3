#include "libtracker/core/printable.h"

#include <algorithm>

namespace depthmocap {

std::string printable(std::string_view text, std::size_t most) {
  constexpr char kDelete = 0x7F;
  std::string line(text.substr(0, most));
  std::replace_if(
      line.begin(), line.end(), [](char c) { return (c >= 0 && c < ' ') || c == kDelete; }, '?');
  return text.size() > most ? line + "..." : line;
}

}  // namespace depthmocap
