#include "libtracker/tracker/size_adapter.h"

#include <algorithm>
#include <cmath>

#include "libtracker/actor/make_actor.h"

namespace depthmocap {
namespace {

constexpr double kMinStature_m = 1.0;  // nobody is believed to be smaller or larger than this
constexpr double kMaxStature_m = 2.2;
constexpr int kSlowest = 30;  // the newest frame never weighs less than 1 / kSlowest

}  // namespace

void SizeAdapter::rescale(double scale) {
  const double stature = statureOf(actor_.skeleton.lengths);
  const double bounded = std::clamp(stature * scale, kMinStature_m, kMaxStature_m) / stature;
  actor_ = averageActor(actor_.skeleton.lengths.scaled(bounded), actor_.surface);
}

void SizeAdapter::observe(double scale, double dt_s) {
  if (!adapting()) return;
  remaining_s_ -= dt_s;
  observed_ = std::min(observed_ + 1, kSlowest);
  rescale(std::exp(std::log(std::clamp(scale, 0.8, 1.25)) / observed_));
}

}  // namespace depthmocap
