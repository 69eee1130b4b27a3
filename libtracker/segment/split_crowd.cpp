#include "libtracker/segment/split_crowd.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace depthmocap {
namespace {

// Chosen by hand: no comparison of values is on record (docs/tuning.md).

// [m^2] Less surface in view is one person's.
constexpr float kCrowdArea_m2 = 0.6F;
// [m] A narrower piece is one person: two people side by side are wider.
constexpr float kCrowdWidth_m = 0.65F;
// [m] Width of the strips whose upper ends are compared: less than a head's.
constexpr float kStrip_m = 0.04F;
// [m] Least depth of the dip between two heads: shoulders lie so far below.
constexpr float kDip_m = 0.12F;
// [m^2] Least surface of each of two people: a raised arm has less.
constexpr float kLeastPerson_m2 = 0.25F;
// Least height of the smaller person over the larger one's.
constexpr float kLeastHeightShare = 0.6F;
// Cuts of one image: as many as there can be people to be told apart.
constexpr int kMostCuts = 5;

}  // namespace

void CrowdSplitter::split(const CoarseCloud& cloud, const Eigen::Vector3f& up, std::span<const Identity> known,
                          ComponentFinder& found) {
  const Eigen::Vector3f across = (Eigen::Vector3f::UnitX() - up.x() * up).normalized();
  int cuts = 0;
  for (std::size_t k = 0; k < found.components().size() && cuts < kMostCuts; ++k) {
    const Component& c = found.components()[k];
    if (c.who != kUnknown || c.area_m2 < kCrowdArea_m2 || c.widthX() < kCrowdWidth_m) continue;
    const auto label = static_cast<std::int32_t>(k);
    const std::optional<float> cut = findCut(cloud, up, across, label, found);
    if (!cut) continue;
    found.split(cloud, up, known, label, [&](std::size_t i) { return across.dot(cloud.points[i]) > *cut; });
    ++cuts;
    --k;  // the rest may be a crowd still
  }
}

std::optional<float> CrowdSplitter::findCut(const CoarseCloud& cloud, const Eigen::Vector3f& up,
                                            const Eigen::Vector3f& across, std::int32_t label,
                                            const ComponentFinder& found) {
  float low = std::numeric_limits<float>::max();
  float high = std::numeric_limits<float>::lowest();
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    if (found.labels()[i] != label) continue;
    const float t = across.dot(cloud.points[i]);
    low = std::min(low, t);
    high = std::max(high, t);
  }
  const auto strips = static_cast<std::size_t>((high - low) / kStrip_m) + 1;
  const float bottom = found.components()[static_cast<std::size_t>(label)].bottom_m;
  top_m_.assign(strips, bottom);
  area_m2_.assign(strips, 0.0F);
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    if (found.labels()[i] != label) continue;
    const auto strip = static_cast<std::size_t>((across.dot(cloud.points[i]) - low) / kStrip_m);
    top_m_[strip] = std::max(top_m_[strip], up.dot(cloud.points[i]));
    area_m2_[strip] += cloud.cellArea(cloud.points[i].z());
  }
  float total = 0;
  for (const float area : area_m2_) total += area;
  closed_top_m_ = top_m_;  // without notches narrower than three strips: between a neck and a shoulder
  for (std::size_t s = 1; s + 1 < strips; ++s) closed_top_m_[s] = std::max({top_m_[s - 1], top_m_[s], top_m_[s + 1]});
  std::optional<float> cut;
  float deepest = kDip_m;
  float left_area = 0;
  for (std::size_t s = 1; s + 1 < strips; ++s) {
    left_area += area_m2_[s - 1];
    const auto middle = top_m_.begin() + static_cast<std::ptrdiff_t>(s);
    const float left = *std::max_element(top_m_.begin(), middle);
    const float right = *std::max_element(middle + 1, top_m_.end());
    const float dip = std::min(left, right) - closed_top_m_[s];
    const bool alike = std::min(left, right) - bottom > kLeastHeightShare * (std::max(left, right) - bottom);
    const bool two = left_area >= kLeastPerson_m2 && total - left_area - area_m2_[s] >= kLeastPerson_m2;
    if (!alike || !two || dip <= deepest) continue;
    deepest = dip;
    cut = low + (static_cast<float>(s) + 0.5F) * kStrip_m;
  }
  return cut;
}

}  // namespace depthmocap
