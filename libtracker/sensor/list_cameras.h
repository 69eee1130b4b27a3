#pragma once
#include <string>
#include <vector>

#include "libtracker/sensor/v4l2_system.h"

namespace depthmocap {

// A camera that is there.
struct FoundCamera {
  std::string source;   // its name for openSource
  std::string name;     // of maker and model
  std::string formats;  // V4L2: the pixel formats that hold depth
};

// Cameras of the OpenNI2 runtime; none where the runtime cannot start.
std::vector<FoundCamera> listOpenNiCameras();
// Devices of /dev/video0 to 63 that offer a format that may hold depth, and may be opened.
std::vector<FoundCamera> listV4l2Cameras(V4l2System& system = realV4l2System());

}  // namespace depthmocap
