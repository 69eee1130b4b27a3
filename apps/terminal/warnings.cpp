#include "apps/terminal/warnings.h"

#include <iostream>

#include "libtracker/core/printable.h"

namespace depthmocap {

namespace {
constexpr std::size_t kMostBytes = 1000;  // a path of usual length and what is wrong with it
}  // namespace

void warn(const std::string& text) {
  std::cerr << "depthmocap: warning: " << printable(text, kMostBytes) << '\n';
}

void warn(const std::vector<std::string>& texts) {
  for (const std::string& text : texts) warn(text);
}

}  // namespace depthmocap
