#pragma once
#include <Eigen/Core>
#include <vector>

#include "libtracker/segment/coarse_cloud.h"

namespace depthmocap {

// Unit normal towards the camera of the surface around each cell; zero where it is broken or not measured.
void computeNormals(const CoarseCloud& cloud, std::vector<Eigen::Vector3f>& normals);

}  // namespace depthmocap
