#include "libtracker/posedb/marker_table.h"

#include "libtracker/skeleton/forward_kinematics.h"

namespace depthmocap {

MarkerTable::MarkerTable(const PoseDatabase& database, const Skeleton& skeleton, const MarkerModel& model)
    : values_(database.size() * kStride, 0.0F) {
  ForwardKinematics fk;
  for (std::size_t n = 0; n < database.size(); ++n) {
    fk.update(skeleton, database.pose(n));
    for (std::size_t i = 0; i < kPartCount; ++i) {
      const Eigen::Vector3f p = fk.position(model[i]).cast<float>();
      for (std::size_t axis = 0; axis < 3; ++axis) {
        values_[n * kStride + axis * kMarkerLanes + i] = p[static_cast<Eigen::Index>(axis)];
      }
    }
  }
}

}  // namespace depthmocap
