#include "apps/terminal/status_line.h"

#include <iostream>

#include <unistd.h>

namespace depthmocap {

namespace {
constexpr std::chrono::milliseconds kRedraw{200};
constexpr const char* kClearLine = "\r\033[K";
}  // namespace

StatusLine::StatusLine() : shown_(isatty(STDERR_FILENO) == 1) {}

StatusLine::~StatusLine() {
  if (shown_) std::cerr << kClearLine << std::flush;
}

bool StatusLine::due() {
  const Clock::time_point now = Clock::now();
  if (!shown_ || now - last_drawn_ < kRedraw) return false;
  last_drawn_ = now;
  return true;
}

void StatusLine::show(const std::string& text) {
  std::cerr << kClearLine << text << std::flush;
}

void StatusLine::note(const std::string& text) {
  std::cerr << (shown_ ? kClearLine : "") << "depthmocap: " << text << std::endl;
}

}  // namespace depthmocap
