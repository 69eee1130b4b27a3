#pragma once
#include "depthmocap/camera_model.h"

namespace depthmocap {

// [px] of 640 that the outline of a noisy depth image lies inside the true one: mean over the rendered outlines of a
// structured-light and a time-of-flight camera.
inline constexpr double kLostOutline_px = 0.8;

// The same for the pictures of a camera [px].
inline double lostOutline_px(const CameraModel& camera) {
  return kLostOutline_px * camera.width / 640.0;
}

}  // namespace depthmocap
