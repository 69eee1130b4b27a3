#pragma once
#include <cstdint>
#include <string>
#include <string_view>

#include "libtracker/body/body_surface.h"

namespace depthmocap {

inline constexpr double kAverageBodyMassIndex = 23.5;  // [kg / m^2] of an adult whose weight is not given

// What `synthesize --other` says of somebody else in the view.
struct OtherOption {
  std::string motion;  // as --motion
  double distance_m = 3.5;
  double yaw_deg = 90;
  double aside_m = 0;
  std::int64_t first = 0;  // frame of the motion
  BodyShape shape;
};

// MOTION[,KEY=VALUE...]; throws Error naming what is wrong and what may stand there.
OtherOption parseOther(std::string_view text);

}  // namespace depthmocap
