#include "libtracker/segment/segment.h"

#include <fmt/format.h>

#include "libtracker/core/check.h"
#include "libtracker/core/error.h"
#include "libtracker/segment/choose_person.h"
#include "libtracker/segment/coarse_cloud.h"
#include "libtracker/segment/components.h"
#include "libtracker/segment/join_fragments.h"
#include "libtracker/segment/planes.h"
#include "libtracker/segment/refine_mask.h"
#include "libtracker/segment/surface_shape.h"

namespace depthmocap {

namespace {

constexpr double kFloorMovedShare = 0.6;  // of the floor's cells left on it: the camera moved, look again
constexpr double kReferencePixels = 320.0 * 240.0;

void require(bool holds, const char* field, double value, const char* rule) {
  if (!holds)
    throw Error(fmt::format("{} must be {}, not {}", field, rule, value), "SegmentConfig", "change this option");
}

}  // namespace

void SegmentConfig::validate() const {
  require(min_depth_m >= 0, "min_depth_m", min_depth_m, ">= 0");
  require(max_depth_m > min_depth_m, "max_depth_m", max_depth_m, "> min_depth_m");
  require(floor_distance_m > 0, "floor_distance_m", floor_distance_m, "> 0");
  require(cluster_gap_m > 0, "cluster_gap_m", cluster_gap_m, "> 0");
  require(min_height_m > 0, "min_height_m", min_height_m, "> 0");
  require(max_height_m > min_height_m, "max_height_m", max_height_m, "> min_height_m");
  require(min_pixels >= 1, "min_pixels", min_pixels, ">= 1");
  require(plane_interval >= 1, "plane_interval", plane_interval, ">= 1");
}

struct Segmenter::Impl {
  SegmentConfig config;
  CoarseCloud cloud;
  std::vector<std::uint8_t> keep;
  std::vector<std::uint8_t> selected;
  std::vector<Eigen::Vector3f> normals;
  std::vector<float> box_shares;
  ComponentFinder finder;
  FragmentJoiner joiner;
  PlaneFinder plane_finder;
  RoomPlanes planes;
  double floor_share_when_found = 0;
  int frames_since_planes = -1;  // -1: not looked for yet

  void updatePlanes();
  void removeRoom();
  void summarise(const DepthImage& depth, const CameraModel& camera, Segmentation& out) const;
};

Segmenter::Segmenter(const SegmentConfig& config) : impl_(std::make_unique<Impl>()) {
  config.validate();
  impl_->config = config;
}
Segmenter::~Segmenter() = default;
Segmenter::Segmenter(Segmenter&&) noexcept = default;
Segmenter& Segmenter::operator=(Segmenter&&) noexcept = default;

void Segmenter::reset() {
  impl_->planes = {};
  impl_->frames_since_planes = -1;
}

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
  const Eigen::Vector3f up = planes.floor ? Eigen::Vector3f(planes.floor->head<3>()) : Eigen::Vector3f(0, -1, 0);
  finder.find(cloud, keep, config.cluster_gap_m, up);
  computeNormals(cloud, keep, normals);
  measureBoxShares(normals, finder, up, box_shares);
}

void Segmenter::Impl::summarise(const DepthImage& depth, const CameraModel& camera, Segmentation& out) const {
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

void Segmenter::segment(const DepthImage& depth, const CameraModel& camera,
                        const Eigen::Vector3d* predicted_centroid_camera, Segmentation& out) {
  DMC_CHECK(depth.width == camera.width && depth.height == camera.height && !depth.empty());
  Impl& s = *impl_;
  out.pixel_count = 0;
  out.touches_border = false;
  out.centroid_camera.setZero();
  out.floor_camera.reset();

  buildCoarseCloud(depth, camera, s.config.min_depth_m, s.config.max_depth_m, s.cloud);
  s.keep.assign(s.cloud.points.size(), 1);
  s.finder.find(s.cloud, s.keep, s.config.cluster_gap_m, Eigen::Vector3f(0, -1, 0));
  const bool cut_out = looksCutOut(s.cloud, s.finder.components());
  if (!cut_out) s.removeRoom();

  const double image_scale = static_cast<double>(depth.data.size()) / kReferencePixels;
  const ChoiceContext context{cut_out, s.config.min_pixels * image_scale / (s.cloud.stride * s.cloud.stride),
                              predicted_centroid_camera, cut_out ? nullptr : &s.box_shares};
  const std::int32_t person = choosePerson(s.finder.components(), s.config, context);
  s.selected.assign(s.finder.components().size(), 0);
  if (person != kNoComponent) s.joiner.join(s.cloud, s.finder, person, cut_out, s.selected);

  RefineLimits limits{
      s.config.min_depth_m, s.config.max_depth_m, s.config.cluster_gap_m, s.config.floor_distance_m, {}};
  if (!cut_out) limits.floor = s.planes.floor;
  if (limits.floor) out.floor_camera = limits.floor->cast<double>();
  out.floor_area_m2 = limits.floor ? static_cast<double>(s.planes.floor_area_m2) : 0.0;
  refineMask(depth, camera, s.cloud, s.finder.labels(), s.selected, limits, out.mask);
  s.summarise(depth, camera, out);
}

}  // namespace depthmocap
