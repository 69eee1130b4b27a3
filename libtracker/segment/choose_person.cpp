#include "libtracker/segment/choose_person.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "libtracker/segment/boards.h"

namespace depthmocap {

namespace {

// Chosen by hand: no comparison of values is on record (docs/tuning.md).

// Share of the image's cells that are measured: with fewer the background may have been removed.
constexpr double kCutOutShare = 0.5;
// [m] Greatest width and height of a person where the background is removed.
constexpr float kPersonBox_m = 2.4F;
// [m] Greatest extent of a person along the optical axis.
constexpr float kPersonDepth_m = 2.0F;

// Least share of the map's cells, of those that are measured, that are people where the background was removed.
constexpr double kCutOutPeople = 0.75;

// [m^2] Least surface in view of somebody who is new: head and shoulders.
constexpr float kMinPersonArea_m2 = 0.06F;
// [m] Greatest width of a person in a room: outstretched arms.
constexpr float kWidest_m = 2.2F;
// Least mean logarithm of the odds of somebody who is new: a probability of 0.65. On rendered rooms 0.3 to 1.6 were
// compared (docs/lab/rooms.md).
constexpr float kMinEvidence = 0.6F;
// Mean logarithm of the odds of a person beyond doubt; less counts less in proportion.
constexpr float kPlainEvidence = 2.0F;
// [m] The same below which nothing in a room is a person, however much it looks like one. Of 59 people in rendered
// rooms the flattest had 2.7 cm; cupboards and pictures on walls that were taken for people had 0.9 and 1.0 cm.
constexpr float kFlat_m = 0.018F;
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
constexpr float kUnlikely = 0.02F;
// [cells] Least of the known actor, who may be hidden for the most part.
constexpr int kMinActorCells = 12;
// Share of the actor's usual score: what has less is a chair rather than the actor come back.
constexpr float kAlike = 0.1F;
// Share of the actor's usual area: less may be a hand that was taken for the actor's.
constexpr float kRemnant = 0.25F;

// Where only people should be left, every shape is a person's but that of a board that was held before them.
float cutOutScore(const Component& c) {
  return isPanel(c) ? kPanelShare : 1.0F;
}

float personScore(const Component& c, float evidence, const SegmentConfig& config) {
  const bool too_small = c.height() < static_cast<float>(config.min_height_m) && !c.touches_border &&
                         c.widthX() < static_cast<float>(config.min_height_m);
  const bool too_large =
      c.height() > static_cast<float>(config.max_height_m) || c.widthX() > kWidest_m || c.depthZ() > kPersonDepth_m;
  const bool is_flat = c.thickness_m > 0 && c.thickness_m < kFlat_m;  // 0: too small to say
  if (too_small || too_large || is_flat || c.area_m2 < kMinPersonArea_m2 || evidence < kMinEvidence) return 0;
  const float score = std::min(1.0F, evidence / kPlainEvidence);
  return c.touches_side ? kCutBySideShare * score : score;
}

// 1 at the expected place, 0 where the actor cannot have gone.
float nearness(const Component& c, const ExpectedActor& expected) {
  const float distance = (c.mean - expected.p_camera.cast<float>()).norm();
  if (distance > kExpectedReach_m + kPace_m_s * static_cast<float>(expected.unseen_s)) return 0;
  const float relative = distance / kNearExpected_m;
  return kUnlikely + 1.0F / (1.0F + relative * relative * relative * relative);
}

}  // namespace

bool isSparse(const CoarseCloud& cloud, int but) {
  return cloud.valid_count - but < kCutOutShare * static_cast<double>(cloud.points.size());
}

bool mayBeCutOut(const CoarseCloud& cloud, const std::vector<Component>& components,
                 const std::vector<std::uint8_t>& is_board) {
  int boards = 0;
  for (std::size_t k = 0; k < components.size(); ++k) {
    const Component& c = components[k];
    if (is_board[k] != 0) {
      boards += c.cells;
    } else if (isLarge(c, cloud) &&
               (c.widthX() > kPersonBox_m || c.height() > kPersonBox_m || c.depthZ() > kPersonDepth_m)) {
      return false;
    }
  }
  return isSparse(cloud, boards);
}

bool showsOnlyPeople(const RoomMap& map) {
  int measured = 0;
  int people = 0;
  for (std::size_t m = 0; m < map.person.size(); ++m) {
    measured += map.measured[m];
    people += map.person[m] > 0 ? 1 : 0;
  }
  return people >= kCutOutPeople * measured;
}

void scoreComponents(const std::vector<Component>& components, const SegmentConfig& config,
                     const ChoiceContext& context, std::vector<float>& scores) {
  scores.assign(components.size(), 0.0F);
  for (std::size_t k = 0; k < components.size(); ++k) {
    const Component& c = components[k];
    if (c.cells < context.min_area_cells) continue;
    scores[k] = static_cast<float>(c.cells) / c.mean.z();
    scores[k] *= context.cut_out ? cutOutScore(c) : personScore(c, (*context.evidence)[k], config);
  }
}

Choice choosePerson(const std::vector<Component>& components, const std::vector<float>& scores,
                    const std::vector<Identity>& owners, const WantedPerson& wanted) {
  std::int32_t person = kNoComponent;
  float most = 0;
  for (std::size_t k = 0; k < components.size(); ++k) {
    const Component& c = components[k];
    if (c.who != wanted.who || c.cells < kMinActorCells) continue;
    const float near = wanted.expected != nullptr ? nearness(c, *wanted.expected) : 1.0F;
    const float cells = static_cast<float>(c.cells) * std::max(near, kUnlikely);
    if (cells > most) std::tie(most, person) = std::pair(cells, static_cast<std::int32_t>(k));
  }

  const Component* known = person == kNoComponent ? nullptr : &components[static_cast<std::size_t>(person)];
  const bool sure = known != nullptr && known->area_m2 >= kRemnant * wanted.usual_area_m2;
  Choice choice{person, known != nullptr ? scores[static_cast<std::size_t>(person)] : 0.0F, sure};
  float best = sure ? std::max(choice.score, wanted.usual_score) : choice.score;
  for (std::size_t k = 0; k < components.size(); ++k) {
    if (static_cast<std::int32_t>(k) == person || owners[k] != kUnknown) continue;
    if (components[k].who != kUnknown && (!sure || components[k].who != kSomebodyElse)) continue;
    float score = scores[k];
    if (sure) {
      score *= kUnlikely;
    } else if (wanted.expected != nullptr) {
      const bool is_known = !std::isinf(wanted.expected->unseen_s);
      if (is_known && score < kAlike * wanted.usual_score) continue;
      const float near = nearness(components[k], *wanted.expected);
      if (std::ranges::any_of(wanted.missing,
                              [&](const auto* other) { return nearness(components[k], *other) > near; })) {
        continue;
      }
      score *= near;
    }
    if (score <= best) continue;
    best = score;
    choice = {static_cast<std::int32_t>(k), scores[k], true};
  }
  return choice;
}

}  // namespace depthmocap
