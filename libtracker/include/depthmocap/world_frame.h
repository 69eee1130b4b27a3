#pragma once
#include <Eigen/Core>

namespace depthmocap {

// World frame without knowledge of gravity: y up, x right, z towards the camera; the same origin as the camera.
// p_world = R_world_camera * p_camera; the matrix is its own inverse.
inline Eigen::Matrix3d uprightWorldFromCamera() {
  return Eigen::Vector3d(1.0, -1.0, -1.0).asDiagonal();
}

}  // namespace depthmocap
