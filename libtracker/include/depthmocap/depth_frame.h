#pragma once
#include <cstdint>

#include "depthmocap/image.h"

namespace depthmocap {

// One depth picture of a camera or a recording.
struct DepthFrame {
  std::int64_t frame = 0;  // number in the recording
  double time_s = 0;       // [s] sensor time, strictly increasing
  DepthImage depth;        // [m] undistorted; 0 = no measurement
};

}  // namespace depthmocap
