#pragma once
#include <chrono>
#include <string>

namespace depthmocap {

// One line on stderr that is drawn over and over; where stderr is no terminal it is left out, and only note() shows.
class StatusLine {
 public:
  StatusLine();
  ~StatusLine();  // takes the line off the screen
  StatusLine(const StatusLine&) = delete;
  StatusLine& operator=(const StatusLine&) = delete;

  // True at most five times a second, and never without a terminal: whether to make a text for show().
  [[nodiscard]] bool due();
  void show(const std::string& text);
  // A line that stays.
  void note(const std::string& text);

 private:
  using Clock = std::chrono::steady_clock;
  bool shown_;
  Clock::time_point last_drawn_{};
};

}  // namespace depthmocap
