#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "libtracker/segment/coarse_cloud.h"
#include "libtracker/segment/components.h"

namespace depthmocap {

// Unit normal towards the camera of the surface around each cell; zero where it is broken, not measured or keep[i] ==
// 0.
void computeNormals(const CoarseCloud& cloud, const std::vector<std::uint8_t>& keep,
                    std::vector<Eigen::Vector3f>& normals);

// How much of each component faces one of two directions (15 degrees to each side), [0, 1]: a body is round and stays
// below 0.7, cupboards, sofas and tables are boxes. 0 where too few cells have a normal to tell. `up`: unit, camera
// frame.
void measureBoxShares(const std::vector<Eigen::Vector3f>& normals, const ComponentFinder& found,
                      const Eigen::Vector3f& up, std::vector<float>& box_shares);

}  // namespace depthmocap
