#pragma once
#include <Eigen/Core>

#include "libtracker/posedb/marker_table.h"
#include "libtracker/posedb/pose_search.h"

namespace depthmocap {

// Equation (3) for one query and any database pose, as documented at PoseSearch.
class SearchDistance {
 public:
  // The references must outlive the distance; `table` belongs to `database`.
  SearchDistance(const PoseDatabase& database, const MarkerTable& table, const PoseSearchConfig& config)
      : database_(database), table_(table), config_(config) {}

  void setQuery(const PoseQuery& query);
  [[nodiscard]] double operator()(std::uint32_t n) const;

 private:
  [[nodiscard]] double markerDistance(std::size_t n) const;

  const PoseDatabase& database_;
  const MarkerTable& table_;
  const PoseSearchConfig& config_;
  // The query: weights c_i, c_i / sum, seen markers about their weighted centroid [m] and times c_i / sum.
  MarkerLane weight_ = MarkerLane::Zero();
  MarkerLane share_ = MarkerLane::Zero();
  Eigen::Array<float, kMarkerLanes, 3> centred_ = Eigen::Array<float, kMarkerLanes, 3>::Zero();
  Eigen::Array<float, kMarkerLanes, 3> shared_ = Eigen::Array<float, kMarkerLanes, 3>::Zero();
  bool has_markers_ = false;
  bool has_history_ = false;
  Eigen::Matrix<float, kDofCount, 1> expected_ =
      Eigen::Matrix<float, kDofCount, 1>::Zero();  // 2 q_-1 - q_-2, shape only
};

}  // namespace depthmocap
