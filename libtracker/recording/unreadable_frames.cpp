#include "libtracker/recording/unreadable_frames.h"

#include <algorithm>

#include <fmt/format.h>

namespace depthmocap {

namespace {

constexpr std::size_t kMostKinds = 5;  // reasons that are told; damage has hardly more, and nobody reads more

// Pictures are named by numbers or times.
std::string withoutDigits(std::string text) {
  std::erase_if(text, [](char c) { return c >= '0' && c <= '9'; });
  return text;
}

}  // namespace

void UnreadableFrames::add(const Error& error) {
  const std::string reason = withoutDigits(error.what());
  const auto found = std::ranges::find(kinds_, reason, &Kind::reason);
  if (found != kinds_.end()) {
    ++found->count;
  } else if (kinds_.size() < kMostKinds) {
    kinds_.push_back({reason, error.what(), 1});
  } else {
    ++of_other_kinds_;
  }
}

std::vector<std::string> UnreadableFrames::lines(const std::string& consequence) const {
  std::vector<std::string> lines;
  for (const Kind& kind : kinds_) {
    lines.push_back(kind.count == 1
                        ? fmt::format("{}; frame {}", kind.first, consequence)
                        : fmt::format("{}, and so {} frames in all; {}", kind.first, kind.count, consequence));
  }
  if (of_other_kinds_ > 0) {
    lines.push_back(fmt::format("{} more frames cannot be read for other reasons; {}", of_other_kinds_, consequence));
  }
  return lines;
}

}  // namespace depthmocap
