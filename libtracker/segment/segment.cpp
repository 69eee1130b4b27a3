#include "libtracker/segment/segment.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include <fmt/format.h>

#include "depthmocap/error.h"
#include "libtracker/core/check.h"
#include "libtracker/segment/boards.h"
#include "libtracker/segment/choose_person.h"
#include "libtracker/segment/coarse_cloud.h"
#include "libtracker/segment/components.h"
#include "libtracker/segment/contest.h"
#include "libtracker/segment/expected_body.h"
#include "libtracker/segment/find_floor.h"
#include "libtracker/segment/hidden_part.h"
#include "libtracker/segment/identity.h"
#include "libtracker/segment/join_fragments.h"
#include "libtracker/segment/person_evidence.h"
#include "libtracker/segment/refine_mask.h"
#include "libtracker/segment/split_crowd.h"

namespace depthmocap {

namespace {

// Chosen by hand: no comparison of values is on record (docs/tuning.md).

// Share of the floor's cells that must still lie on it; with fewer the camera has moved.
constexpr double kFloorMovedShare = 0.6;
// [px] Image size that SegmentConfig::min_pixels is given for.
constexpr double kReferencePixels = 320.0 * 240.0;
// [1/frame] Rate at which the usual score and area of a person follow the present ones: a time constant of 50 frames.
constexpr float kUsualRate = 0.02F;
// Share of a person in view that is enough to say that another piece is not theirs.
constexpr double kPlain = 0.6;
// [s] Time for which a hidden person is about where expected.
constexpr double kSurelyThere_s = 1.5;
// [m] Horizontal distance from the expected place within which something new is the hidden person.
constexpr float kTrunk_m = 0.35F;
// [m] Distance from a person within which somebody else is company, so that detached pieces may be theirs.
constexpr float kCompany_m = 1.0F;
// [frames] Time for which company is reckoned with after it was last seen.
constexpr int kCompanyFrames = 30;
// Share of a person's usual score from which another component is somebody.
constexpr float kCompanyLooks = 0.1F;

// A picture is not measured up to its very border: who ends this share of its width before it may go on beyond it.
constexpr int kRimShare = 100;

// Counts the mask's pixels, all of them in the box.
void summarise(const DepthImage& depth, const CameraModel& camera, const PixelBox& box, PersonRegion& out) {
  const int rim = std::max(1, depth.width / kRimShare);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  out.pixel_count = 0;
  out.touches_border = false;
  out.centroid_camera.setZero();
  for (int y = box.y0; y < box.y1; ++y) {
    for (int x = box.x0; x < box.x1; ++x) {
      if (out.mask.at(x, y) == 0) continue;
      ++out.pixel_count;
      sum += camera.unproject(x, y, static_cast<double>(depth.at(x, y)));
      out.touches_border |= x < rim || y < rim || x >= depth.width - rim || y >= depth.height - rim;
    }
  }
  if (out.pixel_count > 0) out.centroid_camera = sum / out.pixel_count;
}

}  // namespace

std::vector<ConfigField> SegmentConfig::fields() {
  return {
      {"min_depth_m", &min_depth_m, "m", atLeast(0), "Nearer measurements are dropped"},
      {"max_depth_m", &max_depth_m, "m", above(0), "Farther measurements are dropped"},
      {"floor_distance_m", &floor_distance_m, "m", above(0),
       "Points this near the floor plane are floor, in addition to what the noise of the sensor needs"},
      {"cluster_gap_m", &cluster_gap_m, "m", above(0), "Points farther apart belong to different clusters"},
      {"min_height_m", &min_height_m, "m", above(0),
       "A person is at least this tall, unless cut by the border of the image"},
      {"max_height_m", &max_height_m, "m", above(0), "A person is at most this tall"},
      {"min_pixels", &min_pixels, "px", atLeast(1), "Fewer pixels at 320x240 are no person"},
      {"plane_interval", &plane_interval, "frames", atLeast(1), "The floor is looked for again after this many"},
  };
}

void SegmentConfig::validate() const {
  checkFieldsOf("SegmentConfig", *this);
  checkConfig(max_depth_m > min_depth_m, "SegmentConfig", "max_depth_m", max_depth_m, "above min_depth_m");
  checkConfig(max_height_m > min_height_m, "SegmentConfig", "max_height_m", max_height_m, "above min_height_m");
}

// What is known of one person from the frames before.
struct Followed {
  float usual_score = 0;    // of the person's looks
  float usual_area_m2 = 0;  // in view, when nothing hides any of it; 0: not known
  bool plain = false;       // most of the person was in view in the frame before
  int company_frames = 0;   // to go until nobody else is reckoned with
};

struct Segmenter::Impl {
  SegmentConfig config;
  CoarseCloud cloud;
  std::vector<std::uint8_t> keep;
  std::vector<std::uint8_t> off_floor;  // 1 for all that could hide somebody
  PersonEvidence evidence;
  ComponentFinder finder;
  CrowdSplitter splitter;
  FragmentJoiner joiner;
  FloorFinder floor_finder;
  std::optional<Floor> floor;
  double floor_share_when_found = 0;
  int frames_since_floor = -1;         // -1: not looked for yet
  bool cut_out = false;                // the background was removed before
  int frames_since_look = -1;          // for a removed background, where looking costs; -1: not looked yet
  std::vector<std::uint8_t> is_board;  // one per component
  DepthImage without_boards;

  // One per component.
  std::vector<float> component_evidence;
  std::vector<float> scores;
  std::vector<Identity> owners;  // whose it is in this frame
  std::vector<std::uint8_t> selected;

  IdentityMemory memory;
  std::vector<Identity> known;      // one per cell
  std::vector<Identity> explained;  // likewise; unknown where the owner's expected pose has no surface
  std::vector<Followed> people;
  std::vector<Choice> choices;                // one per person
  std::vector<const ExpectedActor*> missing;  // people who are out of view for the most part

  [[nodiscard]] Eigen::Vector3f upwards() const {
    return floor ? Eigen::Vector3f(floor->plane.head<3>()) : Eigen::Vector3f(0, -1, 0);
  }
  void updateFloor();
  void recallPeople(const ExpectedPeople& expected);
  void recallHidden(const ExpectedActor& expected, Identity who);
  void explainKnown(const ExpectedPeople& expected);
  void removeRoom(const RoomMap& map, const ExpectedPeople& expected);
  void findComponents(const DepthImage& depth, const RoomLook& look, const ExpectedPeople& expected);
  bool findCutOut(const DepthImage& depth, const RoomLook& look, const RoomMap*& map);
  void weighComponents();
  void findMissing(const ExpectedPeople& expected, std::size_t but);
  Choice choose(const ExpectedActor* expected, Identity who);
  void take(const Choice& choice, Identity who);
  void seeHowMuch(Followed& person, PersonRegion& region) const;
  void rememberPeople();
  void noteCompany(const Choice& choice, Identity who);
};

Segmenter::Segmenter(const SegmentConfig& config) : impl_(std::make_unique<Impl>()) {
  config.validate();
  impl_->config = config;
}
Segmenter::~Segmenter() = default;
Segmenter::Segmenter(Segmenter&&) noexcept = default;
Segmenter& Segmenter::operator=(Segmenter&&) noexcept = default;

// The floor of a still room does not move: look for it now and then, and when it is no longer where it was. People who
// stand in its way are no reason to forget it.
void Segmenter::Impl::updateFloor() {
  const auto share = [&] { return floorShare(cloud, floor->plane, config.floor_distance_m); };
  const bool holds = floor && share() >= kFloorMovedShare * floor_share_when_found;
  const bool due = frames_since_floor < 0 || ++frames_since_floor >= config.plane_interval;
  if (!due && (holds || !floor)) return;
  frames_since_floor = 0;
  const std::optional<Floor> found = floor_finder.find(cloud, evidence.shell(), config.floor_distance_m);
  if (!found && holds) return;
  floor = found;
  floor_share_when_found = floor ? share() : 0;
}

// Assigns identities in the present frame. Who may be anybody is not known any more.
void Segmenter::Impl::recallPeople(const ExpectedPeople& expected) {
  people.resize(expected.size());
  bool anybody_known = false;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const bool is_new = !expected[i] || std::isinf(expected[i]->unseen_s);
    if (is_new) memory.forget(static_cast<Identity>(i + 1));
    if (!expected[i]) people[i] = {};
    anybody_known |= !is_new;
  }
  if (!anybody_known) memory.forgetAll();
  memory.recall(cloud, known);
  settleContest(cloud, expected, known);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    if (expected[i] && !people[i].plain && expected[i]->unseen_s <= kSurelyThere_s) {
      recallHidden(*expected[i], static_cast<Identity>(i + 1));
    }
  }
}

// What was somebody's and lies where their pose has no surface may be a thing that they touch.
void Segmenter::Impl::explainKnown(const ExpectedPeople& expected) {
  explained = known;
  for (std::size_t person = 0; person < expected.size(); ++person) {
    if (!expected[person] || !expected[person]->joints_camera) continue;
    const ExpectedBody body(static_cast<Identity>(person + 1), *expected[person]->joints_camera);
    for (std::size_t i = 0; i < known.size(); ++i) {
      if (known[i] == body.who() && cloud.points[i].z() > 0 && !body.explains(cloud.points[i])) explained[i] = kUnknown;
    }
  }
}

// Surface that appears anew where a hidden person is expected is that person's, also where it touches another.
void Segmenter::Impl::recallHidden(const ExpectedActor& expected, Identity who) {
  const Eigen::Vector3f up = upwards();
  const Eigen::Vector3f trunk = expected.p_camera.cast<float>();
  for (std::size_t i = 0; i < known.size(); ++i) {
    if (known[i] != kUnknown || cloud.points[i].z() <= 0) continue;
    const Eigen::Vector3f d = cloud.points[i] - trunk;
    if ((d - up.dot(d) * up).squaredNorm() < kTrunk_m * kTrunk_m) known[i] = who;
  }
}

void Segmenter::Impl::removeRoom(const RoomMap& map, const ExpectedPeople& expected) {
  explainKnown(expected);
  evidence.read(cloud, map, explained);
  updateFloor();
  keepOffFloor(cloud, floor, config.floor_distance_m, off_floor);
  evidence.smooth(cloud, off_floor, config.cluster_gap_m);
  for (std::size_t i = 0; i < keep.size(); ++i) keep[i] = off_floor[i] != 0 && evidence.odds()[i] > 0 ? 1 : 0;
  finder.find(cloud, keep, config.cluster_gap_m, upwards(), known);
  splitter.split(cloud, upwards(), known, finder);
  weighComponents();
}

// Whether the background was removed; then the pieces are found. What was so is looked at again now and then only. The
// room classifier does not know people behind a board in an otherwise empty picture: boards are taken away first.
// `map`: of the whole picture, if that was looked at.
bool Segmenter::Impl::findCutOut(const DepthImage& depth, const RoomLook& look, const RoomMap*& map) {
  const bool is_due = frames_since_look < 0 || ++frames_since_look >= config.plane_interval;
  if (!is_due && !cut_out && !isSparse(cloud)) return false;
  keep.assign(cloud.points.size(), 1);
  finder.find(cloud, keep, config.cluster_gap_m, Eigen::Vector3f(0, -1, 0), known);
  const bool has_boards = findBoards(cloud, finder.components(), is_board) > 0;
  if (is_due) frames_since_look = 0;
  if (!mayBeCutOut(cloud, finder.components(), is_board)) return false;
  if (!is_due && (cut_out || has_boards)) return cut_out;
  if (has_boards) {
    takeAwayBoards(depth, cloud, finder, is_board, without_boards);
    return showsOnlyPeople(look(without_boards));
  }
  map = &look(depth);
  return showsOnlyPeople(*map);
}

// The pieces that may be people's, and how much they look like people.
void Segmenter::Impl::findComponents(const DepthImage& depth, const RoomLook& look, const ExpectedPeople& expected) {
  const RoomMap* map = nullptr;
  cut_out = findCutOut(depth, look, map);
  if (cut_out) {
    off_floor = keep;
  } else {
    keep.resize(cloud.points.size());
    removeRoom(map != nullptr ? *map : look(depth), expected);
  }
  const double image_scale = static_cast<double>(depth.data.size()) / kReferencePixels;
  const ChoiceContext context{cut_out, config.min_pixels * image_scale / (cloud.stride * cloud.stride),
                              cut_out ? nullptr : &component_evidence};
  scoreComponents(finder.components(), config, context, scores);
  owners.assign(finder.components().size(), kUnknown);
}

void Segmenter::Impl::weighComponents() {
  component_evidence.assign(finder.components().size(), 0.0F);
  for (std::size_t i = 0; i < keep.size(); ++i) {
    const std::int32_t label = finder.labels()[i];
    if (label != kNoComponent) component_evidence[static_cast<std::size_t>(label)] += evidence.odds()[i];
  }
  for (std::size_t k = 0; k < component_evidence.size(); ++k) {
    component_evidence[k] /= static_cast<float>(finder.components()[k].cells);
  }
}

// The others who were hidden in the frame before and are not found yet in this one.
void Segmenter::Impl::findMissing(const ExpectedPeople& expected, std::size_t but) {
  missing.clear();
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const bool is_hidden = expected[i] && !std::isinf(expected[i]->unseen_s) && !people[i].plain;
    if (i != but && is_hidden && choices[i].person == kNoComponent) missing.push_back(&*expected[i]);
  }
}

Choice Segmenter::Impl::choose(const ExpectedActor* expected, Identity who) {
  Followed& person = people[who - 1U];
  const Choice choice = choosePerson(finder.components(), scores, owners,
                                     {who, expected, person.usual_score, person.usual_area_m2, missing});
  if (choice.person == kNoComponent) return choice;
  const bool is_known = finder.components()[static_cast<std::size_t>(choice.person)].who == who;
  person.usual_score = is_known ? person.usual_score + kUsualRate * (choice.score - person.usual_score) : choice.score;
  return choice;
}

// The pieces of one person, in `selected`; from now on they are nobody else's.
void Segmenter::Impl::take(const Choice& choice, Identity who) {
  Followed& person = people[who - 1U];
  selected.assign(finder.components().size(), 0);
  if (choice.person != kNoComponent) {
    joiner.join(cloud, finder, choice.person, who, cut_out, person.company_frames > 0, owners, selected);
  }
  for (std::size_t k = 0; k < selected.size(); ++k) {
    if (selected[k] != 0) owners[k] = who;
  }
}

// How much of the selected pieces' person is in view.
void Segmenter::Impl::seeHowMuch(Followed& person, PersonRegion& region) const {
  float area = 0;
  for (std::size_t k = 0; k < selected.size(); ++k) area += selected[k] != 0 ? finder.components()[k].area_m2 : 0.0F;
  region.covered = isPartlyHidden(cloud, off_floor, finder.labels(), selected);
  const bool use_floor = !cut_out && floor;
  region.cut_below =
      isCutBelow(cloud, off_floor, finder.labels(), selected, use_floor ? std::optional(floor->plane) : std::nullopt);
  if (person.usual_area_m2 <= 0) {
    person.usual_area_m2 = area;
  } else if (!region.covered && area > 0) {
    person.usual_area_m2 += kUsualRate * (area - person.usual_area_m2);
  }
  region.visible_share =
      region.covered && area > 0 ? std::min(1.0, static_cast<double>(area / person.usual_area_m2)) : 1.0;
}

// A component that could have been chosen and was not is somebody else's from now on; but not while one of those who
// are followed is hidden, who may be just that one. A piece that was joined by its place alone may be the first of
// somebody who comes: it stays unknown.
void Segmenter::Impl::rememberPeople() {
  const std::vector<Component>& components = finder.components();
  const bool all_plain = std::ranges::all_of(people, [](const Followed& person) { return person.plain; });
  for (std::size_t k = 0; k < components.size(); ++k) {
    const Component& c = components[k];
    if (owners[k] != kUnknown) {
      const bool is_main = choices[owners[k] - 1U].person == static_cast<std::int32_t>(k);
      if (!is_main && c.who != owners[k]) owners[k] = kUnknown;
    } else if (c.who == kSomebodyElse || (c.who == kUnknown && all_plain && scores[k] > 0)) {
      owners[k] = kSomebodyElse;
    }
  }
  memory.remember(cloud, finder.labels(), owners);
}

void Segmenter::Impl::noteCompany(const Choice& choice, Identity who) {
  Followed& person = people[who - 1U];
  person.company_frames = std::max(0, person.company_frames - 1);
  if (choice.person == kNoComponent) return;
  const std::vector<Component>& components = finder.components();
  const Eigen::Vector3f here = components[static_cast<std::size_t>(choice.person)].mean;
  for (std::size_t k = 0; k < components.size(); ++k) {
    const bool is_another = owners[k] != kUnknown && owners[k] != who;
    const bool is_somebody = is_another && scores[k] > kCompanyLooks * person.usual_score;
    if (is_somebody && (components[k].mean - here).norm() < kCompany_m) person.company_frames = kCompanyFrames;
  }
}

void Segmenter::segment(const DepthImage& depth, const CameraModel& camera, const RoomLook& look,
                        const ExpectedPeople& expected, Segmentation& out) {
  DMC_CHECK(depth.width == camera.width && depth.height == camera.height && !depth.empty());
  DMC_CHECK(!expected.empty() && expected.size() <= kMostPeople);
  Impl& s = *impl_;
  buildCoarseCloud(depth, camera, s.config.min_depth_m, s.config.max_depth_m, s.cloud);
  s.recallPeople(expected);
  s.findComponents(depth, look, expected);

  RefineLimits limits{
      s.config.min_depth_m, s.config.max_depth_m, s.config.cluster_gap_m, s.config.floor_distance_m, {}};
  if (!s.cut_out && s.floor) limits.floor = s.floor->plane;
  out.floor_camera.reset();
  if (limits.floor) out.floor_camera = limits.floor->cast<double>();
  out.floor_area_m2 = limits.floor ? static_cast<double>(s.floor->area_m2) : 0.0;
  out.people.resize(expected.size());
  s.choices.assign(expected.size(), {});
  // First those who are known, then who may be anybody.
  for (const bool anybody : {false, true}) {
    for (std::size_t i = 0; i < expected.size(); ++i) {
      if (expected[i].has_value() == anybody) continue;
      const auto who = static_cast<Identity>(i + 1);
      s.findMissing(expected, i);
      PersonRegion& region = out.people[i];
      region.in_room = !s.cut_out;
      s.choices[i] = s.choose(expected[i] ? &*expected[i] : nullptr, who);
      s.take(s.choices[i], who);
      s.seeHowMuch(s.people[i], region);
      s.people[i].plain = s.choices[i].sure && region.visible_share >= kPlain;
      const PixelBox box = refineMask(depth, camera, s.cloud, s.finder.labels(), s.selected, limits, region.mask);
      summarise(depth, camera, box, region);
    }
  }
  s.rememberPeople();
  for (std::size_t i = 0; i < expected.size(); ++i) s.noteCompany(s.choices[i], static_cast<Identity>(i + 1));
}

}  // namespace depthmocap
