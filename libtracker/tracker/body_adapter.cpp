#include "libtracker/tracker/body_adapter.h"

#include <algorithm>
#include <cmath>

#include "libtracker/actor/make_actor.h"

namespace depthmocap {
namespace {

constexpr double kMinStature_m = 1.0;  // nobody is believed to be smaller or larger than this
constexpr double kMaxStature_m = 2.2;
constexpr int kSlowest = 30;  // the newest frame's size never weighs less than 1 / kSlowest
// [frames] of evidence between two new shapes: each is a surface made anew, and changes little.
constexpr int kShapePeriod = 5;
constexpr int kFewestShapes = 15;  // [frames] of evidence that make a shape better than an average one; by hand

}  // namespace

BodyAdapter::BodyAdapter(const Actor& actor, bool calibrated, double size_s, double shape_s)
    : actor_(actor),
      stature_m_(actor.stature_m()),
      shape_(ShapeFit::typical(stature_m_)),
      size_left_s_(calibrated ? 0.0 : size_s),
      shape_left_s_(calibrated ? 0.0 : shape_s) {}

bool BodyAdapter::isFitted() const {
  return fit_.frames() >= kFewestShapes;
}

BodyAdapter BodyAdapter::fixed() const {
  BodyAdapter fixed = *this;
  fixed.size_left_s_ = fixed.shape_left_s_ = 0;
  return fixed;
}

void BodyAdapter::rescale(double scale) {
  stature_m_ = std::clamp(stature_m_ * scale, kMinStature_m, kMaxStature_m);
  if (fit_.frames() > 0) return wear(fit_.best(stature_m_));
  shape_ = ShapeFit::typical(stature_m_);
  actor_ = averageActor(averageBoneLengths(stature_m_));
}

void BodyAdapter::observeSize(double scale, double dt_s) {
  if (!fitsSize()) return;
  size_left_s_ -= dt_s;
  sizes_ = std::min(sizes_ + 1, kSlowest);
  const double seen = std::clamp(scale, 0.8, 1.25) * actor_.stature_m() / stature_m_;
  rescale(std::exp(std::log(seen) / sizes_));
}

void BodyAdapter::observeShape(const ShapeEvidence& frame, double dt_s) {
  if (!fitsShape()) return;
  shape_left_s_ -= dt_s;
  fit_.observe(frame);
  if (fit_.frames() % kShapePeriod == 0 || !fitsShape()) wear(fit_.best(stature_m_));
}

void BodyAdapter::wear(const ShapeVector& shape) {
  shape_ = shape;
  actor_ = shapedActor(shape);
}

}  // namespace depthmocap
