#include "libtracker/match/outline_matcher.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "libtracker/core/lost_outline.h"
#include "libtracker/match/lorentzian_weight.h"

namespace depthmocap {
namespace {

constexpr int kReach_px = 3;          // half the window that tells the outline's direction
constexpr float kBehind_m = 0.10F;    // what is beside the outline is at least this much further away
constexpr float kRimCosine = 0.25F;   // between normal and line of sight, of a point that is on the rim
constexpr float kSameSide = 0.7F;     // least cosine between the directions of outline and rim
constexpr float kMaxDepth_m = 0.20F;  // between both
constexpr float kMinDepth_m = 0.2F;   // nearer the projection says nothing
constexpr float kBeside_m = 0.01F;    // a step along the normal, to see where it points in the image

bool isBehind(const DepthImage& depth, const MaskImage& mask, int x, int y, float own_m) {
  if (mask.at(x, y) != 0) return false;
  const float other_m = depth.at(x, y);
  return other_m == 0 || other_m > own_m + kBehind_m;
}

// The first pixel of the actor from (x, y) on to the right; the width where there is none.
int firstOf(const MaskImage& mask, int x, int y) {
  const std::uint8_t* row = &mask.at(0, y);
  for (; x + 8 <= mask.width; x += 8) {
    std::uint64_t eight = 0;
    std::memcpy(&eight, row + x, sizeof eight);
    if (eight != 0) break;
  }
  while (x < mask.width && row[x] == 0) ++x;
  return x;
}

// From the middle of the actor's pixels around (x, y) to it.
Eigen::Vector2f outwardAt(const MaskImage& mask, int x, int y) {
  Eigen::Vector2f sum = Eigen::Vector2f::Zero();
  for (int dy = -kReach_px; dy <= kReach_px; ++dy) {
    for (int dx = -kReach_px; dx <= kReach_px; ++dx) {
      if (mask.at(x + dx, y + dy) != 0) sum -= Eigen::Vector2f(static_cast<float>(dx), static_cast<float>(dy));
    }
  }
  return sum.norm() > 0 ? Eigen::Vector2f(sum.normalized()) : Eigen::Vector2f(Eigen::Vector2f::Zero());
}

}  // namespace

std::vector<ConfigField> OutlineConfig::fields() {
  return {
      {"weight", &weight, "", above(0), "Weight of a perfect match against a match of depth"},
      {"max_distance_m", &max_distance_m, "m", above(0),
       "A line of sight that passes the body further away has no match"},
      {"sigma_m", &sigma_m, "m", above(0), "Scale of the Lorentzian that weighs a match by its distance"},
      {"max_matches", &max_matches, "", fromTo(0, kMaxSurfaceMatches), "Matches per frame; 0 = off"},
  };
}

void OutlineConfig::validate() const {
  checkFieldsOf("OutlineConfig", *this);
}

OutlineMatcher::OutlineMatcher(const OutlineConfig& config) : config_(config) {
  config_.validate();
}

void OutlineMatcher::observe(const DepthImage& depth, const MaskImage& mask, const CameraModel& camera,
                             const Eigen::Matrix3d& R_world_camera) {
  camera_ = camera;
  R_world_camera_ = R_world_camera;
  const auto lost = static_cast<float>(lostOutline_px(camera));
  found_.clear();
  outline_.clear();
  if (config_.max_matches == 0) return;
  for (int y = kReach_px; y < mask.height - kReach_px; ++y) {
    for (int x = firstOf(mask, kReach_px, y); x < mask.width - kReach_px; x = firstOf(mask, x + 1, y)) {
      const float own_m = depth.at(x, y);
      if (!isBehind(depth, mask, x - 1, y, own_m) && !isBehind(depth, mask, x + 1, y, own_m) &&
          !isBehind(depth, mask, x, y - 1, own_m) && !isBehind(depth, mask, x, y + 1, own_m)) {
        continue;
      }
      const Eigen::Vector2f outward = outwardAt(mask, x, y);
      if (outward.isZero()) continue;
      const Eigen::Vector2f pixel(static_cast<float>(x), static_cast<float>(y));
      found_.push_back({pixel + lost * outward, outward, own_m});
    }
  }
  const std::size_t count = std::min(found_.size(), static_cast<std::size_t>(config_.max_matches));
  for (std::size_t i = 0; i < count; ++i) outline_.push_back(found_[i * found_.size() / count]);
}

// The rim by rows of the image, so that a pixel looks at its surroundings alone.
void OutlineMatcher::findRim(const SurfaceModel& surface, double scale, const ForwardKinematics& fk) {
  std::array<Eigen::Matrix3f, kBoneCount> R;
  std::array<Eigen::Vector3f, kBoneCount> t;
  const Eigen::Matrix3f R_camera_world = R_world_camera_.transpose().cast<float>();
  for (std::size_t b = 0; b < kBoneCount; ++b) {
    R[b] = R_camera_world * fk.R_world_bone(static_cast<Bone>(b)).cast<float>();
    t[b] = R_camera_world * fk.origin(static_cast<Bone>(b)).cast<float>();
  }
  const auto size = static_cast<float>(scale);
  rim_.clear();
  for (std::size_t part = 0; part < kPartCount; ++part) {
    for (const SurfaceModel::Point& point : surface.parts[part]) {
      const auto b = static_cast<std::size_t>(point.bone);
      const Eigen::Vector3f p = R[b] * (size * point.p_bone) + t[b];
      const Eigen::Vector3f n = R[b] * point.n_bone;
      const float along = n.dot(p);
      const float square = p.squaredNorm();
      if (along * along > kRimCosine * kRimCosine * square || p.z() < kMinDepth_m) continue;
      const Eigen::Vector3f n_rim = (n - along / square * p).normalized();
      Rim rim;
      rim.place = camera_.project(p.cast<double>()).cast<float>();
      rim.outward = (camera_.project((p + kBeside_m * n_rim).cast<double>()).cast<float>() - rim.place).normalized();
      rim.depth_m = p.z();
      rim.n_camera = n_rim;
      rim.p_camera = p;
      rim.point = &point;
      rim.part = partAt(static_cast<int>(part));
      rim_.push_back(rim);
    }
  }
  std::sort(rim_.begin(), rim_.end(), [](const Rim& a, const Rim& b) { return a.place.y() < b.place.y(); });
}

const OutlineMatcher::Rim* OutlineMatcher::nearestRim(const Pixel& pixel) const {
  const float reach = static_cast<float>(config_.max_distance_m * camera_.fx) / pixel.depth_m;
  const Rim* nearest = nullptr;
  float least = reach * reach;
  auto rim = std::lower_bound(rim_.begin(), rim_.end(), pixel.place.y() - reach,
                              [](const Rim& r, float y) { return r.place.y() < y; });
  for (; rim != rim_.end() && rim->place.y() < pixel.place.y() + reach; ++rim) {
    const float distance = (rim->place - pixel.place).squaredNorm();
    if (distance >= least || rim->outward.dot(pixel.outward) < kSameSide) continue;
    if (std::abs(rim->depth_m - pixel.depth_m) > kMaxDepth_m) continue;
    least = distance;
    nearest = &*rim;
  }
  return nearest;
}

void OutlineMatcher::match(const SurfaceModel& surface, double scale, const ForwardKinematics& fk,
                           SurfaceMatches& matches) {
  if (outline_.empty()) return;
  findRim(surface, scale, fk);
  for (const Pixel& pixel : outline_) {
    const Rim* rim = nearestRim(pixel);
    if (rim == nullptr) continue;
    const Eigen::Vector3d p = rim->p_camera.cast<double>();
    const Eigen::Vector3d n = rim->n_camera.cast<double>();
    const Eigen::Vector3d ray =
        camera_.unproject(static_cast<double>(pixel.place.x()), static_cast<double>(pixel.place.y()), 1.0);
    const Eigen::Vector3d touched = ray * (ray.dot(p) / ray.squaredNorm());
    SurfaceMatch match;
    match.model = {rim->point->bone, scale * rim->point->p_bone.cast<double>()};
    match.p_world = R_world_camera_ * touched;
    match.n_world = R_world_camera_ * n;
    match.weight = config_.weight * lorentzianWeight(n.dot(p - touched), config_.sigma_m);
    match.part = rim->part;
    matches.push_back(match);
  }
}

}  // namespace depthmocap
