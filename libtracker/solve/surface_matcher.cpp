#include "libtracker/solve/surface_matcher.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "libtracker/core/error.h"

namespace depthmocap {
namespace {

constexpr float kMinFacing = 0.15F;  // cosine between normal and ray to the camera of a point that counts as seen

}  // namespace

void SurfaceMatchConfig::validate() const {
  if (!(max_distance_m > 0)) throw Error("max_distance_m must be above 0", "surface match settings");
  if (!(min_probability > 0 && min_probability <= 1)) {
    throw Error("min_probability must be above 0 and at most 1", "surface match settings");
  }
  if (!(match_sigma_m > 0)) throw Error("match_sigma_m must be above 0", "surface match settings");
  if (!(sigma_m > 0)) throw Error("sigma_m must be above 0", "surface match settings");
}

SurfaceMatcher::SurfaceMatcher(const SurfaceMatchConfig& config) : config_(config) {
  config_.validate();
}

// The surface points that face the camera, in the world.
void SurfaceMatcher::place(const SurfaceModel& surface, double scale, const ForwardKinematics& fk) {
  std::array<Eigen::Matrix3f, kBoneCount> R;
  std::array<Eigen::Vector3f, kBoneCount> t;
  for (std::size_t b = 0; b < kBoneCount; ++b) {
    R[b] = fk.R_world_bone(static_cast<Bone>(b)).cast<float>();
    t[b] = fk.origin(static_cast<Bone>(b)).cast<float>();
  }
  const auto size = static_cast<float>(scale);
  for (std::size_t part = 0; part < kPartCount; ++part) {
    placed_[part].clear();
    for (std::uint32_t i = 0; i < surface.parts[part].size(); ++i) {
      const SurfaceModel::Point& point = surface.parts[part][i];
      const auto b = static_cast<std::size_t>(point.bone);
      const Eigen::Vector3f p = R[b] * (size * point.p_bone) + t[b];
      const Eigen::Vector3f n = R[b] * point.n_bone;
      if (-n.dot(p) > kMinFacing * p.norm()) placed_[part].push_back({p, n, i});
    }
  }
}

void SurfaceMatcher::match(const SurfaceModel& surface, double scale, const ForwardKinematics& fk,
                           const std::vector<SurfaceSample>& samples, SurfaceMatches& matches) {
  matches.clear();
  place(surface, scale, fk);
  const auto max_d = static_cast<float>(config_.max_distance_m * config_.max_distance_m);
  const auto per_d = static_cast<float>(0.5 / (config_.match_sigma_m * config_.match_sigma_m));
  const auto min_probability = static_cast<float>(config_.min_probability);
  for (const SurfaceSample& sample : samples) {
    if (matches.size() == kMaxSurfaceMatches) return;
    float best = std::numeric_limits<float>::max();
    const Placed* nearest = nullptr;
    std::size_t nearest_part = 0;
    for (std::size_t part = 0; part < kPartCount; ++part) {
      // Half the squared distance over sigma^2, and what the classifier thinks of the part, as log likelihoods.
      const float doubt = -std::log(std::max(sample.probability[part], min_probability));
      for (const Placed& placed : placed_[part]) {
        const float d = (placed.p_world - sample.p_world).squaredNorm();
        const float cost = d * per_d + doubt;
        if (cost >= best || d > max_d) continue;
        best = cost;
        nearest = &placed;
        nearest_part = part;
      }
    }
    if (nearest == nullptr) continue;
    const SurfaceModel::Point& point = surface.parts[nearest_part][nearest->index];
    SurfaceMatch match;
    match.model = {point.bone, scale * point.p_bone.cast<double>()};
    match.p_world = sample.p_world.cast<double>();
    match.n_world = nearest->n_world.cast<double>();
    const double off = match.n_world.dot((nearest->p_world - sample.p_world).cast<double>());
    match.weight = 1.0 / (1.0 + off * off / (2.0 * config_.sigma_m * config_.sigma_m));
    matches.push_back(match);
  }
}

}  // namespace depthmocap
