#pragma once
#include <Eigen/Core>

#include "libtracker/skeleton/skeleton.h"

namespace depthmocap {

// A place on the floor for programs that expect the actor to stand at y = 0 near the origin: below where the hips were
// first seen, at the height of the lower sole. The height follows slowly, because without knowledge of gravity the
// floor of a tilted camera rises or falls with the distance; a jump hardly moves it.
class FloorOrigin {
 public:
  // World, y up [m]; times must grow.
  const Eigen::Vector3d& update(const Skeleton& skeleton, const Pose& q, double time_s);

 private:
  bool started_ = false;
  double time_s_ = 0;
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
};

}  // namespace depthmocap
