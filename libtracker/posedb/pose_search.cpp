#include "libtracker/posedb/pose_search.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <flann/algorithms/dist.h>
#include <flann/algorithms/kdtree_single_index.h>
#include <fmt/format.h>

#include "depthmocap/error.h"
#include "libtracker/core/check.h"
#include "libtracker/posedb/marker_features.h"
#include "libtracker/posedb/marker_table.h"
#include "libtracker/posedb/search_distance.h"

namespace depthmocap {
namespace {

constexpr double kSameRotation = 0.2;  // [rad] rotations closer than this lead to the same candidates
constexpr int kMostStarts = 5;         // rotations that a query may start from
constexpr int kLeafSize = 16;          // [poses] of the kd-tree

using Index = flann::KDTreeSingleIndex<flann::L2_Simple<float>>;

// The nearest poses that one kd-tree search has met so far, as FLANN wants it; keeps its memory from search to search.
class NearestSet : public flann::ResultSet<float> {
 public:
  void reset(std::size_t capacity) {
    capacity_ = capacity;
    heap_.clear();
    heap_.reserve(capacity + 1);
  }
  [[nodiscard]] bool full() const override { return heap_.size() >= capacity_; }
  [[nodiscard]] float worstDist() const override {
    return full() ? heap_.front().first : std::numeric_limits<float>::max();
  }
  void addPoint(float distance, std::size_t index) override {
    const std::pair<float, std::uint32_t> entry(distance, static_cast<std::uint32_t>(index));
    if (full() && !(entry < heap_.front())) return;
    heap_.push_back(entry);
    std::push_heap(heap_.begin(), heap_.end());
    if (heap_.size() <= capacity_) return;
    std::pop_heap(heap_.begin(), heap_.end());
    heap_.pop_back();
  }
  [[nodiscard]] const std::vector<std::pair<float, std::uint32_t>>& entries() const { return heap_; }

 private:
  std::size_t capacity_ = 0;
  std::vector<std::pair<float, std::uint32_t>> heap_;
};

Eigen::Matrix3d headingRotation(double heading) {
  return Eigen::AngleAxisd(heading, Eigen::Vector3d::UnitY()).toRotationMatrix();
}

double angleBetween(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  return Eigen::AngleAxisd(Eigen::Matrix3d(a.transpose() * b)).angle();
}

bool nearer(const PoseNeighbour& a, const PoseNeighbour& b) {
  return a.distance != b.distance ? a.distance < b.distance : a.index < b.index;
}

}  // namespace

std::vector<ConfigField> PoseSearchConfig::fields() {
  return {
      {"alpha", &alpha, "", atLeast(0), "Weight of the marker distance in equation (3)"},
      {"beta", &beta, "", atLeast(0), "Weight of the change of pose in equation (3)"},
      {"sigma_m", &sigma_m, "m", above(0), "Scale of the Lorentzian in equation (3)"},
      {"upright_alignment", &upright_alignment, "", kAnyNumber, "Align by turns about the vertical only"},
      {"candidates", &candidates, "poses", atLeast(1), "Proposed by the index for the exact distance"},
      {"features", &features, "", fromTo(1, kMaxMarkerFeatures),
       "Principal components of the markers that the index holds"},
  };
}

void PoseSearchConfig::validate() const {
  checkFieldsOf("PoseSearchConfig", *this);
}

struct PoseSearch::Impl {
  Impl(const PoseDatabase& database, const Skeleton& skeleton, const MarkerModel& markers,
       const PoseSearchConfig& config_in)
      : config(config_in),
        table(database, skeleton, markers),
        space(table, config.features, config.upright_alignment),
        distance(database, table, config),
        features(table.size() * static_cast<std::size_t>(space.count())),
        index(flann::Matrix<float>(features.data(), table.size(), static_cast<std::size_t>(space.count())),
              flann::KDTreeSingleIndexParams(kLeafSize, true)),
        last_proposal(table.size(), 0) {
    for (std::size_t n = 0; n < table.size(); ++n) {
      const MarkerFeatures z = space.project(table, n);
      std::copy(z.begin(), z.end(), features.begin() + static_cast<std::ptrdiff_t>(n) * z.size());
    }
    index.buildIndex();
    found.reserve(table.size());
    readings.reserve(kMostStarts);
  }

  void interpret(const PoseQuery& query);
  void propose(const PoseQuery& query);
  void takeNearest(int count, std::vector<PoseNeighbour>& neighbours);

  PoseSearchConfig config;
  MarkerTable table;
  MarkerFeatureSpace space;
  SearchDistance distance;
  std::vector<float> features;  // row n: components of pose n
  Index index;
  // Working memory of a search.
  std::vector<MarkerFeatureSpace::Estimate> readings;  // of the query: features and rotation, best first
  NearestSet nearest;
  std::vector<std::uint64_t> last_proposal;  // number of the search that proposed the pose last
  std::uint64_t search_number = 0;
  std::vector<PoseNeighbour> found;
};

// Estimates the query's features from several rotations; keeps the best reading, and the next best that differs.
void PoseSearch::Impl::interpret(const PoseQuery& query) {
  MarkerSet markers = query.markers;
  markers.position /= query.scale;
  std::array<Eigen::Matrix3d, kMostStarts> starts;
  std::size_t start_count = 0;
  starts[start_count++] = space.roughRotation(markers);
  if (query.has_history) {
    starts[start_count++] = headingRotation(-query.heading);
  } else {
    for (int quarter = 0; quarter < 4; ++quarter)
      starts[start_count++] = headingRotation(quarter * std::numbers::pi / 2);
  }
  readings.resize(start_count);
  for (std::size_t i = 0; i < start_count; ++i) space.estimate(markers, starts[i], readings[i]);
  std::sort(readings.begin(), readings.end(), [](const auto& a, const auto& b) { return a.energy < b.energy; });
  const auto other = std::find_if(readings.begin() + 1, readings.end(), [&](const auto& reading) {
    return angleBetween(reading.R, readings.front().R) > kSameRotation;
  });
  const bool has_other = other != readings.end();
  if (has_other) std::swap(readings[1], *other);
  readings.resize(has_other ? 2 : 1);
}

// Fills `found` with the poses nearest to the query's features, an equal share for each reading, each pose once.
void PoseSearch::Impl::propose(const PoseQuery& query) {
  ++search_number;
  found.clear();
  interpret(query);
  const auto share = (static_cast<std::size_t>(config.candidates) + readings.size() - 1) / readings.size();
  const flann::SearchParams params(flann::FLANN_CHECKS_UNLIMITED);
  for (const MarkerFeatureSpace::Estimate& reading : readings) {
    nearest.reset(share);
    index.findNeighbors(nearest, reading.z.data(), params);
    for (const auto& [feature_distance, n] : nearest.entries()) {
      if (std::exchange(last_proposal[n], search_number) != search_number) found.push_back({n, 0});
    }
  }
}

void PoseSearch::Impl::takeNearest(int count, std::vector<PoseNeighbour>& neighbours) {
  for (PoseNeighbour& candidate : found) candidate.distance = distance(candidate.index);
  const std::size_t kept = std::min(static_cast<std::size_t>(std::max(count, 0)), found.size());
  const auto middle = found.begin() + static_cast<std::ptrdiff_t>(kept);
  std::partial_sort(found.begin(), middle, found.end(), nearer);
  neighbours.assign(found.begin(), middle);
}

PoseSearch::PoseSearch(const PoseDatabase& database, const Skeleton& skeleton, const MarkerModel& markers,
                       const PoseSearchConfig& config) {
  config.validate();
  if (database.size() == 0)
    throw Error("the pose database holds no pose", "pose search", "build one with posedb build");
  impl_ = std::make_unique<Impl>(database, skeleton, markers, config);
}
PoseSearch::~PoseSearch() = default;
PoseSearch::PoseSearch(PoseSearch&&) noexcept = default;

void PoseSearch::search(const PoseQuery& query, int count, std::vector<PoseNeighbour>& neighbours) {
  DMC_CHECK(query.scale > 0);
  impl_->distance.setQuery(query);
  impl_->propose(query);
  impl_->takeNearest(count, neighbours);
}

void PoseSearch::searchExhaustive(const PoseQuery& query, int count, std::vector<PoseNeighbour>& neighbours) {
  DMC_CHECK(query.scale > 0);
  impl_->distance.setQuery(query);
  impl_->found.clear();
  for (std::size_t n = 0; n < impl_->table.size(); ++n) impl_->found.push_back({static_cast<std::uint32_t>(n), 0});
  impl_->takeNearest(count, neighbours);
}

}  // namespace depthmocap
