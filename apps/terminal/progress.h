#pragma once
#include <chrono>
#include <cstddef>
#include <string>

namespace depthmocap {

// A progress bar with the remaining time on stderr; silent when stderr is no terminal.
class Progress {
 public:
  // `total` steps (> 0); `label` says what is being done.
  Progress(std::string label, std::size_t total);
  ~Progress();  // takes the bar off the screen
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // `done` steps of the total are finished. Draws at most ten times a second.
  void update(std::size_t done);

 private:
  using Clock = std::chrono::steady_clock;

  std::string label_;
  std::size_t total_;
  bool shown_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_drawn_{};
};

// "[#####...............]  25 %  0:42 left"; the time is left out as long as nothing is done.
std::string progressText(std::size_t done, std::size_t total, double elapsed_s);

}  // namespace depthmocap
