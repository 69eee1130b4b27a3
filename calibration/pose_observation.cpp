#include "calibration/pose_observation.h"

#include <algorithm>
#include <cmath>

#include "depthmocap/world_frame.h"
#include "libtracker/core/lost_outline.h"

namespace depthmocap {
namespace {

using Eigen::Vector3d;

constexpr float kOfThePair = 0.5F;            // least probability of both parts together
constexpr std::size_t kFewestOnEachSide = 8;  // pixels
constexpr double kHeadReach_m = 0.10;         // from the head's marker to the sides: hair apart from an arm above
constexpr double kHandReach_m = 0.12;         // from the arm's marker up and down
constexpr double kFootReach_m = 0.16;         // from the leg's marker to the sides
constexpr int kFewestInLine = 2;              // [px] in a row or column of the mask: less is a stray pixel

int bestPart(const CloudPoint& point) {
  return static_cast<int>(std::max_element(point.probability.begin(), point.probability.end()) -
                          point.probability.begin());
}

}  // namespace

std::vector<CloudPoint> cloudOf(const ClassifiedPixels& pixels, const CameraModel& camera) {
  const Eigen::Matrix3d R_world_camera = uprightWorldFromCamera();
  std::vector<CloudPoint> cloud;
  cloud.reserve(pixels.pixels.size());
  for (const auto& pixel : pixels.pixels) {
    const Vector3d p = R_world_camera * camera.unproject(pixel.x, pixel.y, static_cast<double>(pixel.depth_m));
    cloud.push_back({p.cast<float>(), pixel.probability});
  }
  return cloud;
}

std::vector<CloudPoint> thinned(const std::vector<CloudPoint>& cloud, int per_part) {
  std::array<std::vector<std::size_t>, kPartCount> members;
  for (std::size_t i = 0; i < cloud.size(); ++i) members[static_cast<std::size_t>(bestPart(cloud[i]))].push_back(i);
  std::vector<CloudPoint> result;
  for (const auto& part : members) {
    const std::size_t count = std::min(part.size(), static_cast<std::size_t>(per_part));
    for (std::size_t i = 0; i < count; ++i) result.push_back(cloud[part[i * part.size() / count]]);
  }
  return result;
}

std::vector<Eigen::Vector3f> pointsOf(const std::vector<CloudPoint>& cloud, Part part) {
  std::vector<Eigen::Vector3f> points;
  for (const CloudPoint& point : cloud) {
    if (bestPart(point) == partIndex(part)) points.push_back(point.p_world);
  }
  return points;
}

namespace {

using PartList = std::array<Part, 2>;

float probabilityOf(const CloudPoint& point, const PartList& parts) {
  float sum = 0;
  for (const Part part : parts) {
    if (part != Part::None) sum += point.probability[static_cast<std::size_t>(partIndex(part))];
  }
  return sum;
}

// The place along `direction` that parts `inner` from `outer` with the least misplaced probability.
bool findBoundary(const std::vector<CloudPoint>& cloud, const PartList& inner, const PartList& outer,
                  const Vector3d& direction, double& offset) {
  struct Entry {
    double t;
    double outer_share;  // 1: surely the outer part
  };
  std::vector<Entry> entries;
  for (const CloudPoint& point : cloud) {
    const float a = probabilityOf(point, inner);
    const float b = probabilityOf(point, outer);
    if (a + b < kOfThePair) continue;
    entries.push_back({direction.dot(point.p_world.cast<double>()), static_cast<double>(b / (a + b))});
  }
  if (entries.size() < 2 * kFewestOnEachSide) return false;
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.t < b.t; });
  double cost = 0;  // of the boundary before the first entry
  for (const Entry& entry : entries) cost += 1.0 - entry.outer_share;
  double best = cost;
  std::size_t at = 0;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    cost += 2.0 * entries[i].outer_share - 1.0;
    if (cost >= best) continue;
    best = cost;
    at = i + 1;
  }
  if (at < kFewestOnEachSide || entries.size() - at < kFewestOnEachSide) return false;
  offset = 0.5 * (entries[at - 1].t + entries[at].t);
  return true;
}

}  // namespace

std::vector<PartBoundary> tposeBoundaries(const std::vector<CloudPoint>& cloud, const Vector3d& left,
                                          const Vector3d& up) {
  using Place = PartBoundary::Place;
  std::vector<PartBoundary> boundaries;
  const auto find = [&](Place place, const PartList& inner, const PartList& outer, const Vector3d& direction) {
    PartBoundary boundary{place, direction, 0};
    if (findBoundary(cloud, inner, outer, direction, boundary.offset)) boundaries.push_back(boundary);
  };
  const auto one = [](Part part) { return PartList{part, Part::None}; };
  find(Place::LeftElbow, one(Part::LeftUpperArm), one(Part::LeftLowerArm), left);
  find(Place::RightElbow, one(Part::RightUpperArm), one(Part::RightLowerArm), -left);
  find(Place::LeftArm, one(Part::LeftShoulder), one(Part::LeftUpperArm), left);
  find(Place::RightArm, one(Part::RightShoulder), one(Part::RightUpperArm), -left);
  find(Place::LeftKnee, one(Part::LeftUpperLeg), one(Part::LeftLowerLeg), -up);
  find(Place::RightKnee, one(Part::RightUpperLeg), one(Part::RightLowerLeg), -up);
  find(Place::Waist, one(Part::Torso), {Part::LeftWaist, Part::RightWaist}, -up);
  return boundaries;
}

namespace {

// The range of rows or columns of the mask that a search may use.
struct Window {
  int low, high;  // [px] both included
};

Window windowAbout(double center, double reach_px, int size) {
  return {std::clamp(static_cast<int>(center - reach_px), 0, size - 1),
          std::clamp(static_cast<int>(center + reach_px), 0, size - 1)};
}

int countInRow(const MaskImage& mask, int y, const Window& columns) {
  int count = 0;
  for (int x = columns.low; x <= columns.high; ++x) count += mask.at(x, y) != 0 ? 1 : 0;
  return count;
}

int countInColumn(const MaskImage& mask, int x, const Window& rows) {
  int count = 0;
  for (int y = rows.low; y <= rows.high; ++y) count += mask.at(x, y) != 0 ? 1 : 0;
  return count;
}

// The first row or column from `from` on by `step` that holds enough of the mask; -1 if none does.
template <typename Count>
int firstFull(int from, int step, int size, Count&& count) {
  for (int i = from; i >= 0 && i < size; i += step) {
    if (count(i) >= kFewestInLine) return i;
  }
  return -1;
}

}  // namespace

std::vector<BodyEnd> tposeEnds(const MaskImage& mask, const CameraModel& camera, const MarkerSet& markers,
                               const Eigen::Vector4d* floor_world) {
  const Eigen::Matrix3d R_world_camera = uprightWorldFromCamera();
  const double lost = lostOutline_px(camera);
  std::vector<BodyEnd> ends;
  const auto pixelOf = [&](Part part) {
    return camera.project(R_world_camera.transpose() * markers.position.col(partIndex(part)));
  };
  const auto reach = [&](Part part, double metres) {
    return metres * camera.fx / std::max(0.3, -markers.position(2, partIndex(part)));
  };
  // The plane through the camera and a row of the image, seen from the body: sign -1 for its upper end.
  const auto addRow = [&](Part part, double row, double sign) {
    const Vector3d n_camera = Vector3d(0, camera.fy, camera.cy - row).normalized() * sign;
    ends.push_back({part, R_world_camera * n_camera, 0});
  };
  const auto addColumn = [&](Part part, double column, double sign) {
    const Vector3d n_camera = Vector3d(camera.fx, 0, camera.cx - column).normalized() * sign;
    ends.push_back({part, R_world_camera * n_camera, 0});
  };
  if (markers.seen(partIndex(Part::Head))) {
    const Window columns = windowAbout(pixelOf(Part::Head).x(), reach(Part::Head, kHeadReach_m), mask.width);
    const int row = firstFull(0, 1, mask.height, [&](int y) { return countInRow(mask, y, columns); });
    if (row >= 0) addRow(Part::Head, row - 0.5 - lost, -1.0);
  }
  for (const Part part : {Part::LeftLowerArm, Part::RightLowerArm}) {
    if (!markers.seen(partIndex(part))) continue;
    const bool is_left = part == Part::LeftLowerArm;
    const Window rows = windowAbout(pixelOf(part).y(), reach(part, kHandReach_m), mask.height);
    const auto count = [&](int x) { return countInColumn(mask, x, rows); };
    const int column = is_left ? firstFull(mask.width - 1, -1, mask.width, count) : firstFull(0, 1, mask.width, count);
    const double sign = is_left ? 1.0 : -1.0;
    if (column >= 0) addColumn(part, column + sign * (0.5 + lost), sign);
  }
  for (const Part part : {Part::LeftLowerLeg, Part::RightLowerLeg}) {
    if (!markers.seen(partIndex(part))) continue;
    if (floor_world != nullptr) {
      ends.push_back({part, -floor_world->head<3>(), (*floor_world)[3]});
      continue;
    }
    const Window columns = windowAbout(pixelOf(part).x(), reach(part, kFootReach_m), mask.width);
    const int row = firstFull(mask.height - 1, -1, mask.height, [&](int y) { return countInRow(mask, y, columns); });
    if (row >= 0) addRow(part, row + 0.5 + lost, 1.0);
  }
  return ends;
}

}  // namespace depthmocap
