#include "libtracker/match/part_points.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace depthmocap {
namespace {

constexpr std::size_t kLanes = 8;  // points that are compared at once
constexpr float kFar_m = 1e6F;     // [m] where no point is

// What chooses between clones runs while the program is loaded, before ThreadSanitizer is ready for it.
#ifdef __SANITIZE_THREAD__
#define DMC_CLONES
#else
#define DMC_CLONES [[gnu::target_clones("avx2", "default")]]
#endif

// The least squared distance [m^2] of `count` points, a multiple of kLanes, from p. The two clones round alike.
DMC_CLONES float leastSquare(const float* x, const float* y, const float* z, std::size_t count, float px, float py,
                             float pz) {
  float least[kLanes];
  for (float& lane : least) lane = std::numeric_limits<float>::max();
  for (std::size_t i = 0; i < count; i += kLanes) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const float dx = x[i + lane] - px;
      const float dy = y[i + lane] - py;
      const float dz = z[i + lane] - pz;
      const float square = dx * dx + dy * dy + dz * dz;
      least[lane] = square < least[lane] ? square : least[lane];
    }
  }
  return *std::min_element(std::begin(least), std::end(least));
}

}  // namespace

PartDoubts::PartDoubts(const std::array<float, kPartCount>& probability, double min_probability) {
  const auto least = static_cast<float>(min_probability);
  const float most_doubt = -std::log(least);
  std::iota(part.begin(), part.end(), std::uint8_t{0});
  std::stable_sort(part.begin(), part.end(), [&](std::uint8_t a, std::uint8_t b) {
    return std::max(probability[a], least) > std::max(probability[b], least);
  });
  for (std::size_t i = 0; i < kPartCount; ++i) {
    const float p = probability[part[i]];
    doubt[i] = p > least ? -std::log(p) : most_doubt;
  }
}

void PartPoints::clear() {
  for (Part& part : parts_) {
    part.count = 0;
    part.x.clear();
    part.y.clear();
    part.z.clear();
  }
}

void PartPoints::add(std::size_t part, const Eigen::Vector3f& p_world) {
  Part& points = parts_[part];
  ++points.count;
  points.x.push_back(p_world.x());
  points.y.push_back(p_world.y());
  points.z.push_back(p_world.z());
}

void PartPoints::finish() {
  for (Part& part : parts_) {
    if (part.count == 0) continue;
    using Values = Eigen::Map<const Eigen::ArrayXf>;
    const auto n = static_cast<Eigen::Index>(part.count);
    const Values x(part.x.data(), n);
    const Values y(part.y.data(), n);
    const Values z(part.z.data(), n);
    part.centre = {x.mean(), y.mean(), z.mean()};
    const float square =
        ((x - part.centre.x()).square() + (y - part.centre.y()).square() + (z - part.centre.z()).square()).maxCoeff();
    part.radius = std::sqrt(square);
    const std::size_t blocks = (part.count + kLanes - 1) / kLanes;
    part.x.resize(blocks * kLanes, kFar_m);
    part.y.resize(blocks * kLanes, kFar_m);
    part.z.resize(blocks * kLanes, kFar_m);
  }
}

std::size_t PartPoints::indexOf(const Part& part, const Eigen::Vector3f& p, float square) {
  for (std::size_t i = 0; i < part.count; ++i) {
    const float dx = part.x[i] - p.x();
    const float dy = part.y[i] - p.y();
    const float dz = part.z[i] - p.z();
    if (dx * dx + dy * dy + dz * dz == square) return i;
  }
  return 0;  // does not happen: the square is of one of them
}

std::optional<PartPoints::Found> PartPoints::find(const Eigen::Vector3f& p_world, const PartDoubts& doubts,
                                                  const PointLikelihood& likelihood) const {
  const auto per_square = static_cast<float>(0.5 / (likelihood.sigma_m * likelihood.sigma_m));
  const auto farthest = static_cast<float>(likelihood.reach_m * likelihood.reach_m);
  float best_cost = std::numeric_limits<float>::max();
  float best_square = 0;
  const Part* best = nullptr;
  for (std::size_t i = 0; i < kPartCount && doubts.doubt[i] < best_cost; ++i) {
    const Part& part = parts_[doubts.part[i]];
    if (part.count == 0) continue;
    const float limit = std::min(farthest, (best_cost - doubts.doubt[i]) / per_square);
    const float gap = (part.centre - p_world).norm() - part.radius;  // no point of the part is nearer
    if (gap > 0 && gap * gap > limit) continue;
    const float square =
        leastSquare(part.x.data(), part.y.data(), part.z.data(), part.x.size(), p_world.x(), p_world.y(), p_world.z());
    const float cost = square * per_square + doubts.doubt[i];
    if (square > farthest || cost >= best_cost) continue;
    best_cost = cost;
    best_square = square;
    best = &part;
  }
  if (best == nullptr) return std::nullopt;
  return Found{static_cast<std::size_t>(best - parts_.data()), indexOf(*best, p_world, best_square)};
}

}  // namespace depthmocap
