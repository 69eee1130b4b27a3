#pragma once
#include <string>

#include "depthmocap/camera_model.h"
#include "depthmocap/depth_frame.h"

namespace depthmocap {

// Throws Error naming the field and the rule unless low <= value <= high, also where it is NaN.
void requireRange(const char* field, double value, double low, double high, const std::string& where);

// Throws Error unless the camera can be used: sides in [1, 16384] px and at most 3840 x 2160 pixels, focal lengths in
// [0.1, 1e5] px, the centre within 1e5 px, distortion finite.
void checkCamera(const CameraModel& camera, const std::string& where);

// Throws Error unless the frame has this camera's size and its time is a number.
void checkFrame(const DepthFrame& frame, const CameraModel& camera);

}  // namespace depthmocap
