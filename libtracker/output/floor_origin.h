#pragma once
#include <Eigen/Core>

#include "libtracker/skeleton/floor_height.h"
#include "libtracker/skeleton/skeleton.h"

namespace depthmocap {

// World y [m] of the lower sole.
double lowerSole(const Skeleton& skeleton, const Pose& q);

// A place on the floor for programs that expect the actor to stand at y = 0 near the origin: below where the hips were
// first seen, at the height of the lower sole (see FloorHeight).
class FloorOrigin {
 public:
  // World, y up [m]; times must grow.
  const Eigen::Vector3d& update(const Skeleton& skeleton, const Pose& q, double time_s);

 private:
  bool started_ = false;
  FloorHeight height_;
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
};

}  // namespace depthmocap
