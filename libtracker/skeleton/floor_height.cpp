#include "libtracker/skeleton/floor_height.h"

#include <algorithm>

namespace depthmocap {
namespace {

constexpr double kFall_s = 0.3;  // time constants
constexpr double kRise_s = 4.0;

}  // namespace

double FloorHeight::follow(double sole_y, double time_s) {
  if (!y_) y_ = sole_y;
  const double dt_s = std::max(0.0, time_s - time_s_);
  time_s_ = time_s;
  *y_ += (sole_y - *y_) * dt_s / (dt_s + (sole_y < *y_ ? kFall_s : kRise_s));
  return *y_;
}

}  // namespace depthmocap
