#include "libtracker/segment/segment.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "depthmocap/error.h"
#include "libtracker/core/check.h"
#include "libtracker/segment/choose_person.h"
#include "libtracker/segment/coarse_cloud.h"
#include "libtracker/segment/components.h"
#include "libtracker/segment/hidden_part.h"
#include "libtracker/segment/identity.h"
#include "libtracker/segment/join_fragments.h"
#include "libtracker/segment/planes.h"
#include "libtracker/segment/refine_mask.h"
#include "libtracker/segment/surface_shape.h"

namespace depthmocap {

namespace {

// Chosen by hand: no comparison of values is on record (docs/tuning.md).

// Share of the floor's cells that must still lie on it; with fewer the camera has moved.
constexpr double kFloorMovedShare = 0.6;
// [px] Image size that SegmentConfig::min_pixels is given for.
constexpr double kReferencePixels = 320.0 * 240.0;
// [1/frame] Rate at which the actor's usual score and area follow the present ones: a time constant of 50 frames.
constexpr float kUsualRate = 0.02F;
// Share of the actor in view that is enough to say that another piece is not the actor's.
constexpr double kPlain = 0.6;
// [s] Time for which a hidden actor is about where expected.
constexpr double kSurelyThere_s = 1.5;
// [m] Horizontal distance from the expected place within which something new is the hidden actor.
constexpr float kTrunk_m = 0.35F;
// [m] Distance from the actor within which somebody else is company, so that detached pieces may be theirs.
constexpr float kCompany_m = 1.0F;
// [frames] Time for which company is reckoned with after it was last seen.
constexpr int kCompanyFrames = 30;
// Share of the actor's usual score from which another component is somebody.
constexpr float kCompanyLooks = 0.1F;
// [m^2] Area in view from which a thing is told from the actor for good: somebody may lean on it.
constexpr float kLargeThing_m2 = 0.3F;

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
      {"plane_interval", &plane_interval, "frames", atLeast(1), "Floor and walls are looked for again after this many"},
  };
}

void SegmentConfig::validate() const {
  checkFieldsOf("SegmentConfig", *this);
  checkConfig(max_depth_m > min_depth_m, "SegmentConfig", "max_depth_m", max_depth_m, "above min_depth_m");
  checkConfig(max_height_m > min_height_m, "SegmentConfig", "max_height_m", max_height_m, "above min_height_m");
}

struct Segmenter::Impl {
  SegmentConfig config;
  CoarseCloud cloud;
  std::vector<std::uint8_t> keep;
  std::vector<std::uint8_t> selected;
  std::vector<Eigen::Vector3f> normals;
  std::vector<float> box_shares;
  std::vector<float> scores;
  IdentityMemory memory;
  std::vector<Identity> known;
  std::vector<Identity> identities;
  float usual_score = 0;     // of the actor's looks
  bool actor_plain = false;  // most of the actor was in view in the frame before
  int company_frames = 0;    // to go until nobody else is reckoned with
  float usual_area_m2 = 0;   // in view of the actor, when nothing hides any of it; 0: not known
  ComponentFinder finder;
  FragmentJoiner joiner;
  PlaneFinder plane_finder;
  RoomPlanes planes;
  double floor_share_when_found = 0;
  int frames_since_planes = -1;  // -1: not looked for yet

  [[nodiscard]] Eigen::Vector3f upwards() const {
    return planes.floor ? Eigen::Vector3f(planes.floor->head<3>()) : Eigen::Vector3f(0, -1, 0);
  }
  void updatePlanes();
  void removeRoom();
  Choice chooseActor(const DepthImage& depth, const ExpectedActor* expected, bool cut_out);
  void recallPeople(const ExpectedActor* expected);
  void rememberPeople(const Choice& choice);
  void noteCompany(const Choice& choice);
  double visibleShare();
  void summarise(const DepthImage& depth, const CameraModel& camera, PersonRegion& out) const;
};

Segmenter::Segmenter(const SegmentConfig& config) : impl_(std::make_unique<Impl>()) {
  config.validate();
  impl_->config = config;
}
Segmenter::~Segmenter() = default;
Segmenter::Segmenter(Segmenter&&) noexcept = default;
Segmenter& Segmenter::operator=(Segmenter&&) noexcept = default;

// The planes of a still room do not move: look for them now and then, and when the floor is no longer where it was.
void Segmenter::Impl::updatePlanes() {
  bool due = frames_since_planes < 0 || ++frames_since_planes >= config.plane_interval;
  if (!due && planes.floor) {
    due = floorShare(cloud, *planes.floor, config.floor_distance_m) < kFloorMovedShare * floor_share_when_found;
  }
  if (!due) return;
  plane_finder.find(cloud, config.floor_distance_m, planes);
  floor_share_when_found = planes.floor ? floorShare(cloud, *planes.floor, config.floor_distance_m) : 0;
  frames_since_planes = 0;
}

void Segmenter::Impl::removeRoom() {
  updatePlanes();
  keepOffPlanes(cloud, planes, config.floor_distance_m, keep);
  const Eigen::Vector3f up = upwards();
  finder.find(cloud, keep, config.cluster_gap_m, up, known);
  computeNormals(cloud, keep, normals);
  measureBoxShares(normals, finder, up, box_shares);
}

// Assigns identities in the present frame. Surface that appears anew where the hidden actor is expected is the actor's,
// also where it touches another person.
void Segmenter::Impl::recallPeople(const ExpectedActor* expected) {
  if (expected == nullptr || std::isinf(expected->unseen_s)) memory.forget();
  memory.recall(cloud, known);
  if (expected == nullptr || actor_plain || expected->unseen_s > kSurelyThere_s) return;
  const Eigen::Vector3f up = upwards();
  const Eigen::Vector3f trunk = expected->p_camera.cast<float>();
  for (std::size_t i = 0; i < known.size(); ++i) {
    if (known[i] != Identity::Unknown || cloud.points[i].z() <= 0) continue;
    const Eigen::Vector3f d = cloud.points[i] - trunk;
    if ((d - up.dot(d) * up).squaredNorm() < kTrunk_m * kTrunk_m) known[i] = Identity::Actor;
  }
}

Choice Segmenter::Impl::chooseActor(const DepthImage& depth, const ExpectedActor* expected, bool cut_out) {
  const double image_scale = static_cast<double>(depth.data.size()) / kReferencePixels;
  const ChoiceContext context{cut_out,       config.min_pixels * image_scale / (cloud.stride * cloud.stride),
                              expected,      usual_score,
                              usual_area_m2, cut_out ? nullptr : &box_shares};
  const Choice choice = choosePerson(finder.components(), config, context, scores);
  if (choice.person == kNoComponent) return choice;
  if (expected == nullptr) usual_area_m2 = 0;
  const bool is_known = finder.components()[static_cast<std::size_t>(choice.person)].who == Identity::Actor;
  usual_score = is_known ? usual_score + kUsualRate * (choice.score - usual_score) : choice.score;
  return choice;
}

double Segmenter::Impl::visibleShare() {
  float area = 0;
  for (std::size_t k = 0; k < selected.size(); ++k) area += selected[k] != 0 ? finder.components()[k].area_m2 : 0.0F;
  const bool hidden = isPartlyHidden(cloud, keep, finder.labels(), selected);
  if (usual_area_m2 <= 0) {
    usual_area_m2 = area;
  } else if (!hidden && area > 0) {
    usual_area_m2 += kUsualRate * (area - usual_area_m2);
  }
  return hidden && area > 0 ? std::min(1.0, static_cast<double>(area / usual_area_m2)) : 1.0;
}

// A component that could have been chosen and was not is another person from now on, as are things that people lean on;
// but not while the actor is hidden, who may be just that one. A piece that was joined by its place alone may be the
// first of somebody who comes: it stays unknown.
void Segmenter::Impl::rememberPeople(const Choice& choice) {
  const std::vector<Component>& components = finder.components();
  identities.assign(components.size(), Identity::Unknown);
  for (std::size_t k = 0; k < components.size(); ++k) {
    const Component& c = components[k];
    const bool is_other = c.who == Identity::Other || (actor_plain && (scores[k] > 0 || c.area_m2 > kLargeThing_m2));
    if (static_cast<std::int32_t>(k) == choice.person || (selected[k] != 0 && c.who == Identity::Actor)) {
      identities[k] = Identity::Actor;
    } else if (selected[k] == 0 && is_other && c.who != Identity::Actor) {
      identities[k] = Identity::Other;
    }
  }
  memory.remember(cloud, finder.labels(), identities);
}

void Segmenter::Impl::noteCompany(const Choice& choice) {
  company_frames = std::max(0, company_frames - 1);
  if (choice.person == kNoComponent) return;
  const std::vector<Component>& components = finder.components();
  const Eigen::Vector3f actor = components[static_cast<std::size_t>(choice.person)].mean;
  for (std::size_t k = 0; k < components.size(); ++k) {
    const bool is_somebody = identities[k] == Identity::Other && scores[k] > kCompanyLooks * usual_score;
    if (is_somebody && (components[k].mean - actor).norm() < kCompany_m) company_frames = kCompanyFrames;
  }
}

void Segmenter::Impl::summarise(const DepthImage& depth, const CameraModel& camera, PersonRegion& out) const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int y = 0; y < depth.height; ++y) {
    for (int x = 0; x < depth.width; ++x) {
      if (out.mask.at(x, y) == 0) continue;
      ++out.pixel_count;
      sum += camera.unproject(x, y, static_cast<double>(depth.at(x, y)));
      out.touches_border |= x == 0 || y == 0 || x == depth.width - 1 || y == depth.height - 1;
    }
  }
  if (out.pixel_count > 0) out.centroid_camera = sum / out.pixel_count;
}

void Segmenter::segment(const DepthImage& depth, const CameraModel& camera, const ExpectedActor* expected,
                        Segmentation& out) {
  DMC_CHECK(depth.width == camera.width && depth.height == camera.height && !depth.empty());
  Impl& s = *impl_;
  PersonRegion& actor = out.actor();
  actor.pixel_count = 0;
  actor.touches_border = false;
  actor.centroid_camera.setZero();
  out.floor_camera.reset();

  buildCoarseCloud(depth, camera, s.config.min_depth_m, s.config.max_depth_m, s.cloud);
  s.recallPeople(expected);
  s.keep.assign(s.cloud.points.size(), 1);
  s.finder.find(s.cloud, s.keep, s.config.cluster_gap_m, Eigen::Vector3f(0, -1, 0), s.known);
  const bool cut_out = looksCutOut(s.cloud, s.finder.components());
  if (!cut_out) s.removeRoom();

  const Choice choice = s.chooseActor(depth, expected, cut_out);
  s.selected.assign(s.finder.components().size(), 0);
  if (choice.person != kNoComponent)
    s.joiner.join(s.cloud, s.finder, choice.person, cut_out, s.company_frames > 0, s.selected);
  actor.visible_share = s.visibleShare();
  s.actor_plain = choice.sure && actor.visible_share >= kPlain;
  s.rememberPeople(choice);
  s.noteCompany(choice);

  RefineLimits limits{
      s.config.min_depth_m, s.config.max_depth_m, s.config.cluster_gap_m, s.config.floor_distance_m, {}};
  if (!cut_out) limits.floor = s.planes.floor;
  if (limits.floor) out.floor_camera = limits.floor->cast<double>();
  out.floor_area_m2 = limits.floor ? static_cast<double>(s.planes.floor_area_m2) : 0.0;
  refineMask(depth, camera, s.cloud, s.finder.labels(), s.selected, limits, actor.mask);
  s.summarise(depth, camera, actor);
}

}  // namespace depthmocap
