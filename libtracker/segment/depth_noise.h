#pragma once
#include <algorithm>

namespace depthmocap {

// Depth noise grows with the square of the distance: one standard deviation over depth^2 [1/m]. Khoshelham and Elberink
// 2012 find 4 cm at 5 m with the Kinect of 2010.
inline constexpr float kDepthNoise_per_m = 0.0015F;

// Depth [m] from which on the distance allowed between neighbouring points of one surface grows in proportion to the
// depth: the depth steps of the Kinect of 2010 are 26 mm there, 72 mm at 5 m.
inline constexpr float kGapGrowsFrom_m = 3.0F;

// The factor (>= 1) by which it has grown at this depth [m].
inline float gapGrowth(float depth_m) {
  return std::max(1.0F, depth_m / kGapGrowsFrom_m);
}

}  // namespace depthmocap
