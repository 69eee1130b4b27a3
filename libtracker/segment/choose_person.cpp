#include "libtracker/segment/choose_person.h"

#include <algorithm>

namespace depthmocap {

namespace {

constexpr double kCutOutShare = 0.5;
constexpr double kLargeShare = 0.15;
constexpr float kPersonBox_m = 2.4F;
constexpr float kPersonDepth_m = 2.0F;

constexpr float kMinPersonArea_m2 = 0.12F;  // a crouching or half-seen person; table legs are less
constexpr float kUsualHeight_m = 1.2F;      // shorter pieces are less likely a standing person
constexpr float kUsualWidth_m = 1.0F;       // wider ones too, up to outstretched arms
constexpr float kWidest_m = 2.2F;
constexpr float kPanelThickness_m = 0.012F;   // a door or cupboard front; a body is 4 cm and more
constexpr float kPanelNoise_per_m = 0.0015F;  // and what depth noise adds, times depth^2
constexpr float kThingPenalty = 0.05F;
constexpr float kRoundShare = 0.70F;  // of a surface in two directions: bodies have less,
constexpr float kBoxShare = 0.85F;    // cupboards more
constexpr float kLimbedFill = 0.75F;  // of the upright rectangle around it: limbs and head leave more of it empty,
constexpr float kBoxFill = 0.90F;     // cupboards less
constexpr float kPredictionReach_m = 0.5F;
constexpr float kFarFromPrediction = 0.02F;  // an actor elsewhere is still found when nobody is where one was expected

float fallingFrom(float value, float full_at, float zero_at) {
  return std::clamp((zero_at - value) / (zero_at - full_at), 0.0F, 1.0F);
}

float shapeScore(const Component& c, float box_share, const SegmentConfig& config) {
  const auto min_height = static_cast<float>(config.min_height_m);
  if (c.height() > static_cast<float>(config.max_height_m) || c.widthX() > kWidest_m || c.depthZ() > kPersonDepth_m)
    return 0;
  if ((c.height() < min_height && !c.touches_border) || c.area_m2 < kMinPersonArea_m2) return 0;
  const float tall = std::clamp(c.height() / kUsualHeight_m, 0.1F, 1.0F);
  const float slim = std::max(0.2F, fallingFrom(c.widthX(), kUsualWidth_m, kWidest_m));
  const float thick =
      c.thickness_m < kPanelThickness_m + kPanelNoise_per_m * c.mean.z() * c.mean.z() ? kThingPenalty : 1.0F;
  const float round = std::max(kThingPenalty, fallingFrom(box_share, kRoundShare, kBoxShare));
  const float outline = std::max(kThingPenalty, fallingFrom(c.fill, kLimbedFill, kBoxFill));
  return tall * slim * thick * round * outline;
}

}  // namespace

bool looksCutOut(const CoarseCloud& cloud, const std::vector<Component>& components) {
  const auto cells = static_cast<double>(cloud.points.size());
  if (cloud.valid_count >= kCutOutShare * cells) return false;
  return std::all_of(components.begin(), components.end(), [&](const Component& c) {
    const bool is_large = c.cells >= kLargeShare * cloud.valid_count;
    return !is_large || (c.widthX() <= kPersonBox_m && c.height() <= kPersonBox_m && c.depthZ() <= kPersonDepth_m);
  });
}

std::int32_t choosePerson(const std::vector<Component>& components, const SegmentConfig& config,
                          const ChoiceContext& context) {
  std::int32_t best = kNoComponent;
  float best_score = 0;
  for (std::size_t k = 0; k < components.size(); ++k) {
    const Component& c = components[k];
    if (c.cells < context.min_area_cells) continue;
    float score = static_cast<float>(c.cells) / c.mean.z();
    if (!context.cut_out) score *= shapeScore(c, (*context.box_shares)[k], config);
    if (context.predicted != nullptr) {
      const float distance = (c.mean - context.predicted->cast<float>()).norm() / kPredictionReach_m;
      score *= kFarFromPrediction + 1.0F / (1.0F + distance * distance * distance * distance);
    }
    if (score > best_score) {
      best_score = score;
      best = static_cast<std::int32_t>(k);
    }
  }
  return best;
}

}  // namespace depthmocap
