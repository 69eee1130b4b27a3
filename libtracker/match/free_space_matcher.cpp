#include "libtracker/match/free_space_matcher.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "depthmocap/error.h"

namespace depthmocap {
namespace {

constexpr double kMinDepth_m = 0.2;  // nearer the projection says nothing

// [m] A leg farther from the outline is judged only where the mask has all of the legs. With none judged, ankles of
// a man on a sofa were 7.5 cm off in the image, with all 6.4; legs at rendered tables 5 and 16 cm. 0.06 to 0.25
// compared.
constexpr double kNearOutline_m = 0.08;

bool isOfLeg(Part part) {
  return part == Part::LeftUpperLeg || part == Part::RightUpperLeg || part == Part::LeftLowerLeg ||
         part == Part::RightLowerLeg;
}

}  // namespace

std::vector<ConfigField> FreeSpaceConfig::fields() {
  return {
      {"margin_m", &margin_m, "m", atLeast(0), "The body may reach this far into free space without a penalty"},
      {"sigma_m", &sigma_m, "m", above(0), "Scale of the Lorentzian that weighs a violation by its size"},
      {"weight", &weight, "", aboveUpTo(0, 1), "Weight of a small violation against a surface match"},
      {"max_matches", &max_matches, "", fromTo(0, kMaxSurfaceMatches), "Violations per frame; 0 = off"},
  };
}

void FreeSpaceConfig::validate() const {
  checkFieldsOf("FreeSpaceConfig", *this);
}

FreeSpaceMatcher::FreeSpaceMatcher(const FreeSpaceConfig& config) : config_(config) {
  config_.validate();
  found_.reserve(kMaxSurfaceMatches);
}

void FreeSpaceMatcher::observe(const DepthImage& depth, const MaskImage& mask, const CameraModel& camera,
                               const Eigen::Matrix3d& R_world_camera) {
  depth_ = &depth;
  mask_ = &mask;
  camera_ = camera;
  R_world_camera_ = R_world_camera;
  silhouette_.observe(mask);
}

FreeSpaceMatcher::Violation FreeSpaceMatcher::check(const Eigen::Vector3f& p_world) const {
  const Eigen::Vector3d p = R_world_camera_.transpose() * p_world.cast<double>();
  if (p.z() < kMinDepth_m) return {};
  const Eigen::Vector2d pixel = camera_.project(p);
  const int u = static_cast<int>(std::lround(pixel.x()));
  const int v = static_cast<int>(std::lround(pixel.y()));
  if (!depth_->contains(u, v)) return {};  // out of view: anything may be there
  const auto measured = static_cast<double>(depth_->at(u, v));
  Eigen::Vector3d target;
  if (mask_->at(u, v) != 0) {
    target = p * (measured / p.z());
    if (target.z() <= p.z()) return {};  // on the surface, or hidden behind it
  } else {
    if (measured > 0 && measured < p.z()) return {};  // something stands before it
    const Eigen::Vector2i inside = silhouette_.nearest(u, v);
    target = camera_.unproject(inside.x(), inside.y(), p.z());
  }
  const Eigen::Vector3d away = p - target;
  const double distance = away.norm();
  // A pixel of the coarse outline is as far as this from the outline itself.
  const double grain = mask_->at(u, v) != 0 ? 0.0 : 0.5 * Silhouette::kStep * p.z() / camera_.fx;
  const double allowed = config_.margin_m + grain;
  if (distance <= allowed) return {};
  const Eigen::Vector3d direction = away / distance;
  return {R_world_camera_ * (target + allowed * direction), R_world_camera_ * direction, distance - allowed};
}

double FreeSpaceMatcher::hanging(const PlacedSurface& placed, bool whole, double reach_m) const {
  if (silhouette_.empty()) return 0;
  double sum = 0;
  std::size_t count = 0;
  for (int part = 0; part < kPartCount; ++part) {
    if (!whole && isOfLeg(partAt(part))) continue;
    for (const PlacedSurface::Point& point : placed.parts[static_cast<std::size_t>(part)]) {
      const double ratio = std::min(1.0, check(point.p_world).size_m / reach_m);
      sum += ratio * ratio;
      ++count;
    }
  }
  return count > 0 ? sum / static_cast<double>(count) : 0.0;
}

void FreeSpaceMatcher::match(const PlacedSurface& placed, bool whole, SurfaceMatches& matches) {
  if (config_.max_matches == 0 || silhouette_.empty()) return;
  found_.clear();
  for (int part = 0; part < kPartCount; ++part) {
    const double most_m = !whole && isOfLeg(partAt(part)) ? kNearOutline_m : std::numeric_limits<double>::max();
    for (const PlacedSurface::Point& point : placed.parts[static_cast<std::size_t>(part)]) {
      const Violation violation = check(point.p_world);
      if (violation.size_m <= 0 || violation.size_m > most_m) continue;
      const double ratio = violation.size_m / config_.sigma_m;
      found_.push_back({point.model, violation.target_world, violation.direction_world,
                        config_.weight / (1.0 + 0.5 * ratio * ratio)});
    }
  }
  const std::size_t room = static_cast<std::size_t>(kMaxSurfaceMatches) - matches.size();
  const std::size_t kept = std::min({found_.size(), static_cast<std::size_t>(config_.max_matches), room});
  for (std::size_t i = 0; i < kept; ++i) matches.push_back(found_[i * found_.size() / kept]);
}

}  // namespace depthmocap
