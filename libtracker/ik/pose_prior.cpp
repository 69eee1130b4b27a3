#include "libtracker/ik/pose_prior.h"

namespace depthmocap {

PoseShape shapeOf(const Pose& q) {
  PoseShape shape;
  for (int i = 0; i < kShapeDofCount; ++i) shape[i] = q[kShapeDofs[static_cast<std::size_t>(i)]];
  return shape;
}

Pose withShape(const Pose& q, const PoseShape& shape) {
  Pose result = q;
  for (int i = 0; i < kShapeDofCount; ++i) result[kShapeDofs[static_cast<std::size_t>(i)]] = shape[i];
  return result;
}

}  // namespace depthmocap
