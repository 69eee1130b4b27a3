#pragma once
#include <Eigen/Core>
#include <array>
#include <vector>

#include "depthmocap/parts.h"
#include "depthmocap/skeleton.h"

namespace depthmocap {

// Points spread over the body's surface, each rigid with its bone: what the dense term of the solve compares depth
// with.
struct SurfaceModel {
  struct Point {
    Bone bone = Bone::Root;
    Eigen::Vector3f p_bone = Eigen::Vector3f::Zero();  // [m]
    Eigen::Vector3f n_bone = Eigen::Vector3f::Zero();  // unit, outwards
  };
  double stature_m = 0;                              // [m] of the body that the points were taken from
  std::array<std::vector<Point>, kPartCount> parts;  // index = partIndex(part)
};

}  // namespace depthmocap
