#include "libtracker/smooth/pose_smoother.h"

#include <cmath>
#include <numbers>

#include "libtracker/core/check.h"

namespace depthmocap {
namespace {

// Between these the knob moves on a logarithmic scale.
struct Range {
  double weakest;
  double strongest;
  [[nodiscard]] double at(double strength) const { return weakest * std::pow(strongest / weakest, strength); }
};
constexpr Range kMinCutoff_hz{8.0, 0.5};
constexpr Range kBetaRotation{6.0, 1.0};      // [Hz per rad/s]
constexpr Range kBetaTranslation{12.0, 3.0};  // [Hz per m/s]

}  // namespace

PoseSmoother::PoseSmoother(double strength) {
  DMC_CHECK(strength >= 0 && strength <= 1);
  if (strength <= 0) return;
  OneEuroConfig config;
  config.min_cutoff_hz = kMinCutoff_hz.at(strength);
  for (int i = 0; i < kDofCount; ++i) {
    config.beta = (i < kFirstRotationDof ? kBetaTranslation : kBetaRotation).at(strength);
    filters_.emplace_back(config);
  }
}

Pose PoseSmoother::smooth(const Pose& q, double time_s) {
  if (!on()) return q;
  Pose result;
  constexpr double kTurn = 2.0 * std::numbers::pi;
  const double turns = started_ ? std::round((q[kRootRy] - heading_) / kTurn) : 0.0;
  heading_ = q[kRootRy] - kTurn * turns;
  started_ = true;
  for (int i = 0; i < kDofCount; ++i) {
    result[i] = filters_[static_cast<std::size_t>(i)].filter(i == kRootRy ? heading_ : q[i], time_s);
  }
  return result;
}

void PoseSmoother::reset() {
  for (OneEuro& filter : filters_) filter.reset();
  started_ = false;
}

}  // namespace depthmocap
