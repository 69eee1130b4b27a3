#pragma once
#include <vector>

#include "depthmocap/camera.h"
#include "libtracker/sensor/v4l2_system.h"

namespace depthmocap {

// Devices of /dev/video0 to 63 that offer a format that may hold depth, and may be opened.
std::vector<FoundCamera> listV4l2Cameras(V4l2System& system = realV4l2System());

}  // namespace depthmocap
