#pragma once
#include <Eigen/Core>
#include <array>
#include <vector>

#include "depthmocap/parts.h"
#include "libtracker/skeleton/skeleton.h"

namespace depthmocap {

inline constexpr int kMaxSurfaceMatches = 1000;

// A measured point and the point of the body's surface that it should lie on.
struct SurfaceMatch {
  BonePoint model;                                    // [m] on the surface
  Eigen::Vector3d p_world = Eigen::Vector3d::Zero();  // [m] measured
  Eigen::Vector3d n_world = Eigen::Vector3d::Zero();  // unit normal of the surface at the time of matching
  double weight = 0;                                  // (> 0) against a perfect match of usual noise
  Part part = Part::None;                             // that the point of the surface is of
};

using SurfaceMatches = std::vector<SurfaceMatch>;  // at most kMaxSurfaceMatches

}  // namespace depthmocap
