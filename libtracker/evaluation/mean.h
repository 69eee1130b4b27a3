#pragma once
#include <limits>

namespace depthmocap {

// a / b, NaN for b = 0: a figure about nothing is no figure.
inline double ratio(double a, double b) {
  return b == 0 ? std::numeric_limits<double>::quiet_NaN() : a / b;
}

// A running mean; NaN as long as nothing was added.
class Mean {
 public:
  void add(double value) {
    sum_ += value;
    ++count_;
  }
  [[nodiscard]] double value() const { return ratio(sum_, static_cast<double>(count_)); }

 private:
  double sum_ = 0;
  long count_ = 0;
};

}  // namespace depthmocap
