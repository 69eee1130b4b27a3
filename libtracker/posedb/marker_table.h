#pragma once
#include <Eigen/Core>
#include <vector>

#include "libtracker/posedb/pose_database.h"
#include "libtracker/skeleton/marker_model.h"

namespace depthmocap {

// Coordinates are padded from 15 markers to 16, so that they fill whole vector registers.
inline constexpr int kMarkerLanes = 16;
using MarkerLane = Eigen::Array<float, kMarkerLanes, 1>;

// The markers a_n of every database pose on one body: root at the origin, heading zero [m].
class MarkerTable {
 public:
  MarkerTable(const PoseDatabase& database, const Skeleton& skeleton, const MarkerModel& model);

  [[nodiscard]] std::size_t size() const { return values_.size() / kStride; }
  // The x (axis 0), y or z coordinates of pose n; index = partIndex, the last lane is 0.
  [[nodiscard]] Eigen::Map<const MarkerLane> lane(std::size_t n, int axis) const {
    return Eigen::Map<const MarkerLane>(&values_[n * kStride + static_cast<std::size_t>(axis * kMarkerLanes)]);
  }

 private:
  static constexpr std::size_t kStride = 3 * kMarkerLanes;
  std::vector<float> values_;
};

}  // namespace depthmocap
