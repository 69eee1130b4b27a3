#include "libtracker/smooth/one_euro.h"

#include <cmath>
#include <numbers>

namespace depthmocap {
namespace {

// Weight of the newest sample in an exponential low pass of this cutoff.
double weight(double cutoff_hz, double dt_s) {
  const double r = 2.0 * std::numbers::pi * cutoff_hz * dt_s;
  return r / (r + 1.0);
}

}  // namespace

double OneEuro::filter(double value, double time_s) {
  const double dt_s = time_s - time_s_;
  if (!started_ || !(dt_s > 0)) {
    started_ = true;
    time_s_ = time_s;
    speed_ = 0;
    raw_ = value_ = value;
    return value_;
  }
  speed_ += weight(config_.derivative_cutoff_hz, dt_s) * ((value - raw_) / dt_s - speed_);
  value_ += weight(config_.min_cutoff_hz + config_.beta * std::abs(speed_), dt_s) * (value - value_);
  raw_ = value;
  time_s_ = time_s;
  return value_;
}

}  // namespace depthmocap
