#pragma once
#include <algorithm>
#include <chrono>
#include <deque>

namespace depthmocap {

// Events of the last second, on this computer's clock.
class RateMeter {
 public:
  using Clock = std::chrono::steady_clock;
  void count(Clock::time_point now = Clock::now()) {
    forget(now);
    times_.push_back(now);
  }
  // [1/s]. Over the time since the first event where that is less than a second.
  [[nodiscard]] double perSecond(Clock::time_point now = Clock::now()) {
    forget(now);
    if (times_.size() < 2) return 0;
    const double span_s = std::chrono::duration<double>(times_.back() - times_.front()).count();
    return span_s > 0 ? static_cast<double>(times_.size() - 1) / span_s : 0.0;
  }

 private:
  static constexpr std::chrono::seconds kWindow{1};
  void forget(Clock::time_point now) {
    while (!times_.empty() && now - times_.front() > kWindow) times_.pop_front();
  }
  std::deque<Clock::time_point> times_;
};

// [ms] since `start`.
inline double millisecondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace depthmocap
