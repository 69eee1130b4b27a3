#include "libtracker/markers/find_markers.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "depthmocap/error.h"

namespace depthmocap {

namespace {

// Chosen by hand: no comparison of values is on record (docs/tuning.md).

// Edge of the voting cubes, as a share of the bandwidth: small enough not to move a mode noticeably.
constexpr double kVoxelShare = 0.35;
// Ascents per part, from its densest places.
constexpr int kMaxStarts = 4;
// [cubes] Most at which the density is looked up to find those places.
constexpr std::size_t kMaxProbes = 256;
// Share of the greatest density: weaker places are not worth an ascent.
constexpr float kMinStartShare = 0.2F;
// A mode at the prediction beats a distant one up to 1 + this times as dense.
constexpr float kPredictionGain = 0.5F;
// [m] Distance from the prediction at which that gain is halved.
constexpr float kPredictionReach_m = 0.15F;
// Share of the expected surface from which the area does not limit the confidence.
constexpr double kFullAreaShare = 0.3;
// Share of the confidence that a rival mode of equal density takes.
constexpr double kRivalPenalty = 0.5;
// Least confidence of a marker that was found.
constexpr double kMinConfidence = 0.01;

Eigen::Vector3f voteAt(const PartVotes& votes, int i) {
  const auto k = static_cast<std::size_t>(i);
  return {votes.x[k], votes.y[k], votes.z[k]};
}

}  // namespace

std::vector<ConfigField> MarkerConfig::fields() {
  return {
      {"bandwidth_m", &bandwidth_m, "m", between(0, 1),
       "Bandwidth of the MeanShift kernel, times bandwidth_scale of the part"},
      {"min_probability", &min_probability, "", fromTo(0, 1), "A pixel votes for a part from this probability on"},
      {"min_area_m2", &min_area_m2, "m2", above(0), "Probability-weighted surface below which a part gives no marker"},
      {"max_iterations", &max_iterations, "", atLeast(1), "Iterations of MeanShift"},
      {"push_in", &push_in, "", kAnyNumber, "Move the mode into the body along the viewing ray"},
      {"bandwidth_scale", std::span<double>(bandwidth_scale), "", between(0, 100),
       "Width of the kernel of each part, in the order of the parts"},
  };
}

void MarkerConfig::validate() const {
  checkFieldsOf("MarkerConfig", *this);
}

MarkerFinder::MarkerFinder(const MarkerConfig& config) : config_(config) {
  config_.validate();
}

void MarkerFinder::find(const ClassifiedPixels& pixels, const CameraModel& camera,
                        const std::array<double, kPartCount>& radii_m, const MarkerSet* prediction, MarkerSet& out) {
  voxels_.build(pixels, camera, config_.min_probability, kVoxelShare * config_.bandwidth_m);
  out.position.setZero();
  out.confidence.setZero();
  for (int part = 0; part < kPartCount; ++part) {
    findPart(part, radii_m[static_cast<std::size_t>(part)], prediction, out);
  }
}

void MarkerFinder::findPart(int part, double radius_m, const MarkerSet* prediction, MarkerSet& out) {
  voxels_.gather(part, votes_);
  if (votes_.size() == 0) return;
  const auto bandwidth =
      static_cast<float>(config_.bandwidth_m * config_.bandwidth_scale[static_cast<std::size_t>(part)]);
  const double push = config_.push_in ? radius_m : 0.0;
  Eigen::Vector3f expected = Eigen::Vector3f::Zero();
  const bool has_expected =
      prediction != nullptr && prediction->seen(part) && prediction->position.col(part).norm() > push;
  if (has_expected) {
    const Eigen::Vector3d inside = prediction->position.col(part);
    expected = (inside - push * inside.normalized()).cast<float>();
  }
  collectModes(votes_, bandwidth, has_expected ? &expected : nullptr);
  const auto best =
      std::max_element(modes_.begin(), modes_.end(), [](const Mode& a, const Mode& b) { return a.score < b.score; });
  if (best == modes_.end()) return;
  const double confidence = confidenceOf(votes_, *best, bandwidth, radius_m);
  if (!(confidence > 0)) return;
  const Eigen::Vector3d surface = best->position.cast<double>();
  out.position.col(part) = surface + push * surface.normalized();
  out.confidence[part] = confidence;
}

// The densest places at least two bandwidths apart are the starting points, so that no strong mode is missed.
void MarkerFinder::collectModes(const PartVotes& votes, float bandwidth_m, const Eigen::Vector3f* expected) {
  modes_.clear();
  start_index_.clear();
  start_density_.clear();
  const std::size_t stride = (votes.size() + kMaxProbes - 1) / kMaxProbes;
  for (std::size_t i = 0; i < votes.size(); i += stride) {
    start_index_.push_back(static_cast<int>(i));
    start_density_.push_back(mean_shift_.density(votes, voteAt(votes, static_cast<int>(i)), bandwidth_m));
  }
  float strongest = 0;
  for (int n = 0; n < kMaxStarts; ++n) {
    const auto top = std::max_element(start_density_.begin(), start_density_.end());
    strongest = std::max(strongest, *top);
    if (!(*top > kMinStartShare * strongest)) break;
    const Eigen::Vector3f start = voteAt(votes, start_index_[static_cast<std::size_t>(top - start_density_.begin())]);
    addMode(votes, start, bandwidth_m, expected);
    for (std::size_t i = 0; i < start_index_.size(); ++i) {
      if ((voteAt(votes, start_index_[i]) - start).norm() < 2 * bandwidth_m) start_density_[i] = 0;
    }
  }
  if (expected != nullptr) addMode(votes, *expected, bandwidth_m, expected);
}

void MarkerFinder::addMode(const PartVotes& votes, const Eigen::Vector3f& start, float bandwidth_m,
                           const Eigen::Vector3f* expected) {
  Mode mode{start};
  mode.density = mean_shift_.climb(votes, bandwidth_m, config_.max_iterations, mode.position);
  if (!(mode.density > 0)) return;
  for (const Mode& known : modes_) {
    if ((known.position - mode.position).norm() < bandwidth_m) return;
  }
  mode.score = mode.density;
  if (expected != nullptr) {
    const float distance = (mode.position - *expected).norm() / kPredictionReach_m;
    mode.score *= 1.0F + kPredictionGain / (1.0F + distance * distance);
  }
  modes_.push_back(mode);
}

double MarkerFinder::confidenceOf(const PartVotes& votes, const Mode& best, float bandwidth_m, double radius_m) const {
  double weight = 0;
  double area = 0;
  for (std::size_t i = 0; i < votes.size(); ++i) {
    if ((voteAt(votes, static_cast<int>(i)) - best.position).norm() > 2 * bandwidth_m) continue;
    weight += static_cast<double>(votes.weight[i]);
    area += static_cast<double>(votes.area[i]);
  }
  if (weight < config_.min_area_m2) return 0;
  // A cylinder of the part's radius, seen from the side over the reach of the kernel.
  const double expected_area = 4 * radius_m * static_cast<double>(bandwidth_m);
  const double area_term = std::min(1.0, weight / (kFullAreaShare * std::max(expected_area, config_.min_area_m2)));
  const double sureness = weight / area;
  float rival = 0;
  for (const Mode& mode : modes_) {
    const bool elsewhere = (mode.position - best.position).norm() > 2 * bandwidth_m;
    if (elsewhere) rival = std::max(rival, mode.density);
  }
  const double rivalry = std::min(1.0, static_cast<double>(rival / best.density));
  return std::clamp(area_term * sureness * (1.0 - kRivalPenalty * rivalry), kMinConfidence, 1.0);
}

}  // namespace depthmocap
