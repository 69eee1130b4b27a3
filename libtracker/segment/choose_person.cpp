#include "libtracker/segment/choose_person.h"

#include <algorithm>
#include <cmath>

#include "libtracker/segment/depth_noise.h"

namespace depthmocap {

namespace {

// Chosen by hand: no comparison of values is on record (docs/tuning.md).

// Share of the image's cells that are measured: with fewer the background may have been removed.
constexpr double kCutOutShare = 0.5;
// Share of the measured cells: components from here on must fit a person's box where the background is removed.
constexpr double kLargeShare = 0.15;
// [m] Greatest width and height of a person where the background is removed.
constexpr float kPersonBox_m = 2.4F;
// [m] Greatest extent of a person along the optical axis.
constexpr float kPersonDepth_m = 2.0F;

// What a person looks like among furniture. Each measure is a share from 1 (as a person) down to kThingShare; above 0,
// so that one bad measure alone rules nobody out.
constexpr float kThingShare = 0.05F;
// [m^2] Least surface in view of a crouching or half-seen person; table legs have less.
constexpr float kMinPersonArea_m2 = 0.12F;
// [m] Greatest width of a person in a room: outstretched arms.
constexpr float kWidest_m = 2.2F;
// [m] Shorter pieces are less likely a standing person, in proportion.
constexpr float kUsualHeight_m = 1.3F;
// [m] Mean width of the uppermost 20 cm up to which it is a head or two raised hands.
constexpr float kHeadWidth_m = 0.28F;
// [m] Mean width of the uppermost 20 cm from which it is the top of furniture.
constexpr float kBoxTopWidth_m = 0.45F;
// [m] Area over height up to which it is a body.
constexpr float kBodyWidth_m = 0.60F;
// [m] Area over height from which it is a sofa.
constexpr float kSofaWidth_m = 1.10F;
// [m^2] Largest surface in view of one person, from the front.
constexpr float kLargestArea_m2 = 0.95F;
// [m^2] Surface in view from which it is two people or a cupboard.
constexpr float kTooLargeArea_m2 = 1.4F;
// Share of the surface that faces its two main directions (surface_shape.h): bodies have less.
constexpr float kRoundShare = 0.75F;
// The same share of a perfect box; cupboards come near.
constexpr float kBoxShare = 1.0F;
// Filled share of the upright rectangle around it: limbs and head leave more of it empty.
constexpr float kLimbedFill = 0.75F;
// The same share from which it is a cupboard.
constexpr float kBoxFill = 0.90F;
// [m] Standard deviation across the surface of a door or the front of a cupboard, to which depth noise adds
// (kDepthNoise_per_m); a body's is 4 cm and more.
constexpr float kPanelThickness_m = 0.012F;
// Score of a board where the background is removed. Where a board hid a tenth of the actor, joints were 25 mm off with
// it and 0.8 m without (docs/tuning.md).
constexpr float kPanelShare = 0.001F;
// Factor of a component that the left or right border cuts: less likely the actor.
constexpr float kCutBySideShare = 0.5F;
// [m] Distance from the expected place at which a candidate counts half.
constexpr float kNearExpected_m = 0.5F;
// [m] Farthest that the actor can be from the expected place when just seen.
constexpr float kExpectedReach_m = 1.0F;
// [m/s] Growth of that distance while the actor is not seen: after a second it is the whole room.
constexpr float kPace_m_s = 3.0F;
// Factor of a candidate that is not the known actor, or far from the expected place.
constexpr float kSomebodyElse = 0.02F;
// [cells] Least of the known actor, who may be hidden for the most part.
constexpr int kMinActorCells = 12;
// Share of the actor's usual score: what has less is a chair rather than the actor come back.
constexpr float kAlike = 0.1F;
// Share of the actor's usual area: less may be a hand that was taken for the actor's.
constexpr float kRemnant = 0.25F;

// 1 up to `full_at`, falling to kThingShare at `thing_at`.
float likeness(float value, float full_at, float thing_at) {
  return std::max(kThingShare, std::clamp((thing_at - value) / (thing_at - full_at), 0.0F, 1.0F));
}

bool isPanel(const Component& c) {
  return c.thickness_m < kPanelThickness_m + kDepthNoise_per_m * c.mean.z() * c.mean.z();
}

// Where only people should be left, every shape is a person's but that of a board that was held before them.
float cutOutScore(const Component& c) {
  return isPanel(c) ? kPanelShare : 1.0F;
}

float shapeScore(const Component& c, float box_share, const SegmentConfig& config) {
  const bool too_small = c.height() < static_cast<float>(config.min_height_m) && !c.touches_border;
  const bool too_large =
      c.height() > static_cast<float>(config.max_height_m) || c.widthX() > kWidest_m || c.depthZ() > kPersonDepth_m;
  if (too_small || too_large || c.area_m2 < kMinPersonArea_m2) return 0;
  float score = std::clamp(c.height() / kUsualHeight_m, 0.1F, 1.0F);
  score *= c.touches_top ? 1.0F : likeness(c.top_width_m, kHeadWidth_m, kBoxTopWidth_m);
  score *= likeness(c.area_m2 / c.height(), kBodyWidth_m, kSofaWidth_m);
  score *= likeness(c.area_m2, kLargestArea_m2, kTooLargeArea_m2);
  score *= likeness(box_share, kRoundShare, kBoxShare);
  score *= likeness(c.fill, kLimbedFill, kBoxFill);
  score *= isPanel(c) ? kThingShare : 1.0F;
  return c.touches_side ? kCutBySideShare * score : score;
}

// 1 at the expected place, 0 where the actor cannot have gone.
float nearness(const Component& c, const ExpectedActor& expected) {
  const float distance = (c.mean - expected.p_camera.cast<float>()).norm();
  if (distance > kExpectedReach_m + kPace_m_s * static_cast<float>(expected.unseen_s)) return 0;
  const float relative = distance / kNearExpected_m;
  return kSomebodyElse + 1.0F / (1.0F + relative * relative * relative * relative);
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

Choice choosePerson(const std::vector<Component>& components, const SegmentConfig& config, const ChoiceContext& context,
                    std::vector<float>& scores) {
  scores.assign(components.size(), 0.0F);
  std::int32_t actor = kNoComponent;
  for (std::size_t k = 0; k < components.size(); ++k) {
    const Component& c = components[k];
    if (c.cells >= context.min_area_cells) {
      scores[k] = static_cast<float>(c.cells) / c.mean.z();
      scores[k] *= context.cut_out ? cutOutScore(c) : shapeScore(c, (*context.box_shares)[k], config);
    }
    const bool larger = actor == kNoComponent || c.cells > components[static_cast<std::size_t>(actor)].cells;
    if (c.who == Identity::Actor && c.cells >= kMinActorCells && larger) actor = static_cast<std::int32_t>(k);
  }

  const Component* known = actor == kNoComponent ? nullptr : &components[static_cast<std::size_t>(actor)];
  const bool sure = known != nullptr && known->area_m2 >= kRemnant * context.usual_area_m2;
  Choice choice{actor, known != nullptr ? scores[static_cast<std::size_t>(actor)] : 0.0F, sure};
  float best = sure ? std::max(choice.score, context.usual_score) : choice.score;
  for (std::size_t k = 0; k < components.size(); ++k) {
    if (static_cast<std::int32_t>(k) == actor || (!sure && components[k].who == Identity::Other)) continue;
    float score = scores[k];
    if (sure) {
      score *= kSomebodyElse;
    } else if (context.expected != nullptr) {
      const bool is_known = !std::isinf(context.expected->unseen_s);
      if (is_known && score < kAlike * context.usual_score) continue;
      score *= nearness(components[k], *context.expected);
    }
    if (score <= best) continue;
    best = score;
    choice = {static_cast<std::int32_t>(k), scores[k], true};
  }
  return choice;
}

}  // namespace depthmocap
