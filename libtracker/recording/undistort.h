#pragma once
#include <cstdint>
#include <vector>

#include "depthmocap/camera_model.h"
#include "depthmocap/image.h"

namespace depthmocap {

// For each pixel of the picture that the same pinhole camera would take without distortion: the index of the nearest
// pixel of the distorted picture, -1 where there is none. Brown-Conrady, coefficients k1 k2 p1 p2 k3 as in OpenCV.
// Nearest, because depth must not be mixed across the edge of a body.
std::vector<std::int32_t> undistortionMap(const CameraModel& camera);

// Stored depth steps to metres, moved by `map` (empty: not moved). `depth` gets the size of `raw`.
void toMetres(const Image<std::uint16_t>& raw, double depth_unit_m, const std::vector<std::int32_t>& map,
              DepthImage& depth);

}  // namespace depthmocap
