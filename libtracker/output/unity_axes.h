#pragma once
#include <Eigen/Geometry>

namespace depthmocap {

// Our x is the actor's left, Unity's is the actor's right: the mirror image at the plane x = 0.
inline Eigen::Vector3d inUnity(const Eigen::Vector3d& p) {
  return {-p.x(), p.y(), p.z()};
}

inline Eigen::Quaterniond inUnity(const Eigen::Quaterniond& q) {
  return {q.w(), q.x(), -q.y(), -q.z()};
}

}  // namespace depthmocap
