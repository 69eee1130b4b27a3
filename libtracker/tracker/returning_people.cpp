#include "libtracker/tracker/returning_people.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace depthmocap {
namespace {

// Chosen by hand: no comparison of values is on record (docs/tuning.md).

// [m] Difference of two heights that counts 1: hair, shoes, a bent neck.
constexpr double kHeight_m = 0.05;
// [m] Distance between leaving and coming that counts 1: half of a room.
constexpr double kPlace_m = 2.0;
// Counts for a height that is not known.
constexpr double kNoHeight = 1.0;
// Counts for a number that nobody had: who is more unlike everybody is somebody new. 12 cm of height alone are.
constexpr double kStranger = 6.0;
// [frames] Most that a mean height remembers.
constexpr int kMostHeights = 100;
// [px] Of the upper end: fewer are noise.
constexpr int kCrownPixels = 20;

// Height above the floor of the row of the mask down to which there are some pixels.
std::optional<double> topOf(const MaskImage& mask, const DepthImage& depth, const CameraModel& camera,
                            const Eigen::Vector4d& floor_camera) {
  int count = 0;
  for (int y = 0; y < mask.height; ++y) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    int here = 0;
    for (int x = 0; x < mask.width; ++x) {
      if (mask.at(x, y) == 0) continue;
      sum += camera.unproject(x, y, static_cast<double>(depth.at(x, y)));
      ++here;
    }
    count += here;
    if (here > 0 && count >= kCrownPixels) return floor_camera.head<3>().dot(sum / here) + floor_camera[3];
  }
  return std::nullopt;
}

}  // namespace

ReturningPeople::ReturningPeople(std::size_t people, const CameraModel& camera)
    : camera_(camera), places_(people), known_(people) {
  std::iota(places_.begin(), places_.end(), std::size_t{0});
}

ReturningPeople::Look ReturningPeople::lookOf(const PersonRegion& region, const Segmentation& seen,
                                              const DepthImage& depth) const {
  Look look{region.centroid_camera, std::nullopt};
  const bool whole = !region.touches_border && !region.covered;
  if (whole && seen.floor_camera) look.top_m = topOf(region.mask, depth, camera_, *seen.floor_camera);
  return look;
}

double ReturningPeople::unlikeness(std::size_t number, const Look& look) const {
  if (!known_[number]) return kStranger;
  const Look& known = known_[number]->look;
  const double place = (look.p_camera - known.p_camera).norm() / kPlace_m;
  const double height = look.top_m && known.top_m ? (*look.top_m - *known.top_m) / kHeight_m : kNoHeight;
  return place * place + height * height;
}

void ReturningPeople::assign(const ExpectedPeople& expected, const Segmentation& seen, const DepthImage& depth) {
  free_.clear();
  new_.clear();
  for (std::size_t number = 0; number < places_.size(); ++number) {
    const std::size_t place = places_[number];
    if (expected[place]) continue;
    free_.push_back(number);
    if (seen.people[place].pixel_count > 0) new_.push_back(place);
  }
  if (free_.size() < 2) return;
  for (const std::size_t place : new_) {
    const Look look = lookOf(seen.people[place], seen, depth);
    const auto best = std::ranges::min_element(free_, {}, [&](std::size_t number) { return unlikeness(number, look); });
    std::iter_swap(std::ranges::find(places_, place), places_.begin() + static_cast<std::ptrdiff_t>(*best));
    free_.erase(best);
  }
}

void ReturningPeople::observe(std::size_t number, const Segmentation& seen, const DepthImage& depth) {
  if (places_.size() < 2) return;
  const Look look = lookOf(seen.people[places_[number]], seen, depth);
  if (!known_[number]) known_[number].emplace();
  Known& known = *known_[number];
  known.look.p_camera = look.p_camera;
  if (!look.top_m) return;
  known.heights = std::min(known.heights + 1, kMostHeights);
  const double before = known.look.top_m.value_or(0.0);
  known.look.top_m = before + (*look.top_m - before) / known.heights;
}

void ReturningPeople::forget() {
  std::ranges::fill(known_, std::nullopt);
}

}  // namespace depthmocap
