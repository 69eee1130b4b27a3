#include "libtracker/segment/choose_person.h"

#include <algorithm>
#include <cmath>
#include <limits>

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
constexpr float kPanelPenalty = 0.05F;
constexpr float kPredictionReach_m = 0.5F;
constexpr float kFarFromPrediction = 0.02F;  // an actor elsewhere is still found when nobody is where one was expected

constexpr float kLimbGap_m = 0.35F;          // a leg behind a bent trunk, where the background is removed
constexpr float kStackedGap_m = 0.25F;       // legs under a bent trunk, in a room
constexpr float kRoomGap_m = 0.12F;          // a piece cut off by an arm or by noise, in a room
constexpr float kArmReach_m = 0.75F;         // hand to body across an unmeasured forearm
constexpr float kHandArea_m2 = 0.08F;        // hand and forearm, from the front
constexpr float kMinPieceArea_m2 = 0.0012F;  // smaller pieces are speckles
constexpr float kOwnPersonHeight_m = 0.8F;
constexpr float kOwnPersonArea_m2 = 0.3F;  // both legs of a tall adult, from the front
constexpr std::size_t kSamples = 250;      // points of a component for distances between components

float fallingFrom(float value, float full_at, float zero_at) {
  return std::clamp((zero_at - value) / (zero_at - full_at), 0.0F, 1.0F);
}

float shapeScore(const Component& c, const SegmentConfig& config) {
  const auto min_height = static_cast<float>(config.min_height_m);
  if (c.height() > static_cast<float>(config.max_height_m) || c.widthX() > kWidest_m || c.depthZ() > kPersonDepth_m)
    return 0;
  if ((c.height() < min_height && !c.touches_border) || c.area_m2 < kMinPersonArea_m2) return 0;
  const float tall = std::clamp(c.height() / kUsualHeight_m, 0.1F, 1.0F);
  const float slim = std::max(0.2F, fallingFrom(c.widthX(), kUsualWidth_m, kWidest_m));
  const float thick =
      c.thickness_m < kPanelThickness_m + kPanelNoise_per_m * c.mean.z() * c.mean.z() ? kPanelPenalty : 1.0F;
  return tall * slim * thick;
}

// More than a hand and a forearm.
bool isLarge(const Component& piece) {
  return piece.area_m2 >= kHandArea_m2;
}

// A piece that stands beside the actor and is large enough to be somebody else.
bool isOwnPerson(const Component& piece, const Component& body) {
  const float overlap = std::min(piece.top_m, body.top_m) - std::max(piece.bottom_m, body.bottom_m);
  return piece.height() > kOwnPersonHeight_m && piece.area_m2 > kOwnPersonArea_m2 && overlap > 0.5F * piece.height();
}

// Lower bound of the distance between two components [m].
float boxGap(const Component& a, const Component& b) {
  return (a.low - b.high).cwiseMax(b.low - a.high).cwiseMax(0.0F).norm();
}

// How far from the rest of the body a piece may lie [m].
float reachOf(const Component& piece, const Component& body, bool cut_out) {
  if (cut_out) return isLarge(piece) ? kLimbGap_m : kArmReach_m;
  // In a room, what lies low before the body is a thing on the floor, and what lies behind is the room.
  const bool before_body = piece.mean.z() < body.mean.z() && piece.bottom_m > body.bottom_m + 0.2F * body.height();
  const float shared_width = std::min(piece.high.x(), body.high.x()) - std::max(piece.low.x(), body.low.x());
  if (isLarge(piece) && shared_width > 0.9F * piece.widthX() && piece.depthZ() < body.depthZ() + kStackedGap_m) {
    return kStackedGap_m;
  }
  return !isLarge(piece) && before_body ? kArmReach_m : kRoomGap_m;
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
    float score = static_cast<float>(c.cells) / c.mean.z() * (context.cut_out ? 1.0F : shapeScore(c, config));
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

void FragmentJoiner::samplePoints(const CoarseCloud& cloud, const ComponentFinder& found) {
  const std::vector<Component>& components = found.components();
  if (samples_.size() < components.size()) samples_.resize(components.size());
  for (auto& sample : samples_) sample.clear();
  seen_.assign(components.size(), 0);
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    if (found.labels()[i] == kNoComponent) continue;
    const auto label = static_cast<std::size_t>(found.labels()[i]);
    const std::size_t step = 1 + static_cast<std::size_t>(components[label].cells) / kSamples;
    if (seen_[label]++ % step == 0) samples_[label].push_back(cloud.points[i]);
  }
}

float FragmentJoiner::gapBetween(std::int32_t a, std::int32_t b) const {
  float best = std::numeric_limits<float>::max();
  for (const Eigen::Vector3f& p : samples_[static_cast<std::size_t>(a)]) {
    for (const Eigen::Vector3f& q : samples_[static_cast<std::size_t>(b)]) best = std::min(best, (p - q).squaredNorm());
  }
  return std::sqrt(best);
}

bool FragmentJoiner::belongs(const std::vector<Component>& components, std::int32_t piece, float reach_m,
                             const std::vector<std::uint8_t>& selected) const {
  float gap_to_actor = std::numeric_limits<float>::max();
  float gap_to_others = std::numeric_limits<float>::max();
  for (std::size_t k = 0; k < components.size(); ++k) {
    if (static_cast<std::int32_t>(k) == piece || (selected[k] == 0 && !isLarge(components[k]))) continue;
    float& gap = selected[k] != 0 ? gap_to_actor : gap_to_others;
    if (boxGap(components[static_cast<std::size_t>(piece)], components[k]) > std::min(gap, kArmReach_m)) continue;
    gap = std::min(gap, gapBetween(piece, static_cast<std::int32_t>(k)));
  }
  // Large pieces near each other may both be legs; a small one goes to whom it is nearer.
  const bool contested = !isLarge(components[static_cast<std::size_t>(piece)]) && gap_to_others < gap_to_actor;
  return gap_to_actor <= reach_m && !contested;
}

void FragmentJoiner::join(const CoarseCloud& cloud, const ComponentFinder& found, std::int32_t person, bool cut_out,
                          std::vector<std::uint8_t>& selected) {
  const std::vector<Component>& components = found.components();
  const Component& body = components[static_cast<std::size_t>(person)];
  selected.assign(components.size(), 0);
  selected[static_cast<std::size_t>(person)] = 1;
  samplePoints(cloud, found);
  for (const bool large : {true, false}) {  // first limbs and trunk; what large is left then belongs to others
    for (bool grown = true; grown;) {       // a joined forearm may bring in the hand
      grown = false;
      for (std::size_t k = 0; k < components.size(); ++k) {
        const Component& c = components[k];
        const bool possible = selected[k] == 0 && isLarge(c) == large && c.area_m2 >= kMinPieceArea_m2;
        if (!possible || isOwnPerson(c, body)) continue;
        if (!belongs(components, static_cast<std::int32_t>(k), reachOf(c, body, cut_out), selected)) continue;
        selected[k] = 1;
        grown = true;
      }
    }
  }
}

}  // namespace depthmocap
