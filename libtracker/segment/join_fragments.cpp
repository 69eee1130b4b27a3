#include "libtracker/segment/join_fragments.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "libtracker/segment/hidden_part.h"

namespace depthmocap {

namespace {

// Chosen by hand: no comparison of values is on record (docs/tuning.md).
// Gaps are the shortest distances between the points of two pieces.

// [m] Widest gap to a leg behind a bent trunk, where the background is removed.
constexpr float kLimbGap_m = 0.35F;
// [m] Widest gap to a leg or hand that comes out from behind the body, in a room.
constexpr float kHiddenLimbGap_m = 0.45F;
// [m] Widest gap to a piece cut off by an arm or by noise, in a room.
constexpr float kRoomGap_m = 0.12F;
// [m] Widest gap between hand and body across an unmeasured forearm.
constexpr float kArmReach_m = 0.75F;
// [m^2] Largest area in view of hand and forearm, from the front.
constexpr float kHandArea_m2 = 0.08F;
// [m^2] Largest area in view of a leg, from the side.
constexpr float kLimbArea_m2 = 0.30F;
// [m] Greatest width of a leg in a stride.
constexpr float kLimbWidth_m = 0.6F;
// [m] Greatest height of a leg.
constexpr float kLegHeight_m = 1.1F;
// Share of the body's height above which no leg reaches.
constexpr float kLegTopShare = 0.65F;
// [m^2] Smaller pieces are speckles.
constexpr float kMinPieceArea_m2 = 0.0012F;
// [m] A taller piece beside the actor may be another person.
constexpr float kOwnPersonHeight_m = 0.8F;
// [m^2] A larger piece beside the actor may be another person: both legs of a tall adult, from the front.
constexpr float kOwnPersonArea_m2 = 0.3F;
// [m] Widest gap to a taller piece that was the actor's in the frame before: a pole that stands before somebody is
// narrower.
constexpr float kPoleGap_m = 0.25F;
// [points] About so many of each piece are compared for gaps; more take time.
constexpr std::size_t kSamples = 250;
// [cells] Silhouettes this near in the image touch.
constexpr int kContactReach = 3;
// [m] By how much a limb leads before or behind the body on the other side of what hides it.
constexpr float kLimbDepth_m = 0.3F;
// [cells] Least number that touch with the actor in front.
constexpr int kContactCells = 3;

// More than a hand and a forearm.
bool isLarge(const Component& piece) {
  return piece.area_m2 >= kHandArea_m2;
}

// Tall, and at the actor's height.
bool standsBeside(const Component& piece, const Component& body) {
  const float overlap = std::min(piece.top_m, body.top_m) - std::max(piece.bottom_m, body.bottom_m);
  return piece.height() > kOwnPersonHeight_m && overlap > 0.5F * piece.height();
}

// A piece that is known to be somebody else's, or stands beside the actor and is large enough for it: then it is, also
// if it was the actor's in the frame before, in which both were one piece.
bool isOwnPerson(const Component& piece, const Component& body, Identity who) {
  if (piece.who != kUnknown && piece.who != who) return true;
  return standsBeside(piece, body) && piece.area_m2 > kOwnPersonArea_m2;
}

// Lower bound of the distance between two components [m].
float boxGap(const Component& a, const Component& b) {
  return (a.low - b.high).cwiseMax(b.low - a.high).cwiseMax(0.0F).norm();
}

bool isAboveTheFloor(const Component& piece, const Component& body) {
  return piece.bottom_m > body.bottom_m + 0.2F * body.height();
}

// A leg by its size and place, or something of a hand's size that does not stand on the floor.
bool couldBeHiddenLimb(const Component& piece, const Component& body) {
  if (!isLarge(piece) && isAboveTheFloor(piece, body)) return true;
  const bool leg_sized = piece.area_m2 < kLimbArea_m2 && piece.widthX() < kLimbWidth_m && piece.height() < kLegHeight_m;
  return leg_sized && piece.top_m < body.bottom_m + kLegTopShare * body.height();
}

}  // namespace

struct FragmentJoiner::Search {
  const CoarseCloud& cloud;
  const std::vector<Component>& components;
  const std::vector<std::int32_t>& labels;
  const Component& body;
  Identity who;
  bool cut_out;
  bool company;
  const std::vector<std::uint8_t>& selected;

  // True where the piece's silhouette meets the actor's with the actor in front: the rest of the piece is behind it.
  [[nodiscard]] bool comesOutFromBehind(std::size_t piece) const;
  // True where the piece goes on above, behind something nearer, as the actor: a shin under a table's edge.
  [[nodiscard]] bool goesOnBehindThings(std::size_t piece) const;
  [[nodiscard]] bool meetsActorAbove(int x, int top, float z_m) const;
  // How far from the rest of the body the piece may lie [m].
  [[nodiscard]] float reachOf(std::size_t piece) const;
};

bool FragmentJoiner::Search::comesOutFromBehind(std::size_t piece) const {
  constexpr std::array<std::array<int, 2>, 4> kDirections{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
  int contacts = 0;
  for (int y = 0; y < cloud.height; ++y) {
    for (int x = 0; x < cloud.width; ++x) {
      const std::size_t i = cloud.index(x, y);
      if (labels[i] != static_cast<std::int32_t>(piece)) continue;
      for (int step = 1; step <= 4 * kContactReach; ++step) {
        const auto& direction = kDirections[static_cast<std::size_t>(step % 4)];
        const int nx = x + direction[0] * ((step + 3) / 4);
        const int ny = y + direction[1] * ((step + 3) / 4);
        if (nx < 0 || ny < 0 || nx >= cloud.width || ny >= cloud.height) continue;
        const std::size_t j = cloud.index(nx, ny);
        if (labels[j] == kNoComponent || selected[static_cast<std::size_t>(labels[j])] == 0) continue;
        if (cloud.points[j].z() < cloud.points[i].z() && ++contacts >= kContactCells) return true;
        break;
      }
    }
  }
  return false;
}

// Whether the first of the actor straight above this cell comes after nothing but what is nearer.
bool FragmentJoiner::Search::meetsActorAbove(int x, int top, float z_m) const {
  bool covered = false;
  for (int y = top - 1; y >= 0; --y) {
    const std::size_t j = cloud.index(x, y);
    const float z = cloud.points[j].z();
    if (labels[j] != kNoComponent && selected[static_cast<std::size_t>(labels[j])] != 0) {
      return covered && std::abs(z - z_m) < kLimbDepth_m;
    }
    if (z <= 0) continue;
    if (z > z_m - kInFront_m) return false;
    covered = true;
  }
  return false;
}

bool FragmentJoiner::Search::goesOnBehindThings(std::size_t piece) const {
  int columns = 0;
  for (int x = 0; x < cloud.width; ++x) {
    for (int y = 0; y < cloud.height; ++y) {
      const std::size_t i = cloud.index(x, y);
      if (labels[i] != static_cast<std::int32_t>(piece)) continue;
      if (meetsActorAbove(x, y, cloud.points[i].z()) && ++columns >= kContactCells) return true;
      break;
    }
  }
  return false;
}

float FragmentJoiner::Search::reachOf(std::size_t piece) const {
  const Component& c = components[piece];
  if (c.who == who) return standsBeside(c, body) ? kPoleGap_m : kArmReach_m;
  if (company) return kRoomGap_m;
  if (cut_out) return isLarge(c) ? kLimbGap_m : kArmReach_m;
  // In a room, what lies low before the body is a thing on the floor, what stands apart behind it is the room, and what
  // comes in at the side of the picture is somebody else.
  if (c.touches_side && !body.touches_side) return kRoomGap_m;
  if (!isLarge(c) && c.mean.z() < body.mean.z() && isAboveTheFloor(c, body)) return kArmReach_m;
  const bool is_hidden_limb = couldBeHiddenLimb(c, body) && (comesOutFromBehind(piece) || goesOnBehindThings(piece));
  return is_hidden_limb ? kHiddenLimbGap_m : kRoomGap_m;
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

float FragmentJoiner::gapBetween(std::size_t a, std::size_t b) const {
  float best = std::numeric_limits<float>::max();
  for (const Eigen::Vector3f& p : samples_[a]) {
    for (const Eigen::Vector3f& q : samples_[b]) best = std::min(best, (p - q).squaredNorm());
  }
  return std::sqrt(best);
}

bool FragmentJoiner::belongs(const Search& search, std::size_t piece) const {
  const Component& c = search.components[piece];
  float gap_to_actor = std::numeric_limits<float>::max();
  float gap_to_others = std::numeric_limits<float>::max();
  for (std::size_t k = 0; k < search.components.size(); ++k) {
    const Component& other = search.components[k];
    if (k == piece || (search.selected[k] == 0 && !isLarge(other))) continue;
    float& gap = search.selected[k] != 0 ? gap_to_actor : gap_to_others;
    if (boxGap(c, other) <= std::min(gap, kArmReach_m)) gap = std::min(gap, gapBetween(piece, k));
  }
  // Large pieces near each other may both be legs; a small one goes to whom it is nearer.
  const bool contested = !isLarge(c) && gap_to_others < gap_to_actor;
  return !contested && gap_to_actor <= kArmReach_m && gap_to_actor <= search.reachOf(piece);
}

void FragmentJoiner::join(const CoarseCloud& cloud, const ComponentFinder& found, std::int32_t person, Identity who,
                          bool cut_out, bool company, const std::vector<Identity>& owners,
                          std::vector<std::uint8_t>& selected) {
  const std::vector<Component>& components = found.components();
  const Component& body = components[static_cast<std::size_t>(person)];
  selected.assign(components.size(), 0);
  selected[static_cast<std::size_t>(person)] = 1;
  samplePoints(cloud, found);
  const Search search{cloud, components, found.labels(), body, who, cut_out, company, selected};
  for (const bool large : {true, false}) {  // first limbs and trunk; what large is left then belongs to others
    for (bool grown = true; grown;) {       // a joined forearm may bring in the hand
      grown = false;
      for (std::size_t k = 0; k < components.size(); ++k) {
        const Component& c = components[k];
        const bool possible =
            selected[k] == 0 && owners[k] == kUnknown && isLarge(c) == large && c.area_m2 >= kMinPieceArea_m2;
        if (!possible || isOwnPerson(c, body, who) || !belongs(search, k)) continue;
        selected[k] = 1;
        grown = true;
      }
    }
  }
}

}  // namespace depthmocap
