#include "apps/terminal/progress.h"

#include <algorithm>
#include <cmath>
#include <iostream>

#include <fmt/format.h>
#include <unistd.h>

namespace depthmocap {

namespace {
constexpr std::size_t kBarWidth = 30;  // characters
constexpr std::chrono::milliseconds kRedraw{100};
constexpr const char* kClearLine = "\r\033[K";
}  // namespace

Progress::Progress(std::string label, std::size_t total)
    : label_(std::move(label)), total_(std::max<std::size_t>(total, 1)), shown_(isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
  if (shown_) std::cerr << kClearLine << std::flush;
}

void Progress::update(std::size_t done) {
  if (!shown_) return;
  const Clock::time_point now = Clock::now();
  if (now - last_drawn_ < kRedraw) return;
  last_drawn_ = now;
  const std::chrono::duration<double> elapsed = now - start_;
  std::cerr << kClearLine << label_ << ' ' << progressText(done, total_, elapsed.count()) << std::flush;
}

std::string progressText(std::size_t done, std::size_t total, double elapsed_s) {
  done = std::min(done, total);
  const std::size_t filled = kBarWidth * done / total;
  const std::string bar = std::string(filled, '#') + std::string(kBarWidth - filled, '.');
  std::string text = fmt::format("[{}] {:3d} %", bar, 100 * done / total);
  if (done > 0) {
    const double left_s = elapsed_s / static_cast<double>(done) * static_cast<double>(total - done);
    const auto seconds = static_cast<long>(std::ceil(left_s));
    text += fmt::format("  {}:{:02d} left", seconds / 60, seconds % 60);
  }
  return text;
}

}  // namespace depthmocap
