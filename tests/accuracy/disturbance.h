#pragma once
#include <cstdint>
#include <string>

#include "depthmocap/depth_frame.h"

namespace depthmocap {

// What an experiment does to a frame before the tracker sees it.
struct Disturbance {
  double occluded_share = 0;       // [0, 1) of the actor's pixels that a board in front hides
  std::string occluder = "below";  // the board comes from below (legs), left or right (of the image)
  double board_m = 0;              // [m] distance of the board's front; 0: what it hides is not measured at all
  std::int64_t first_blank = -1;   // frames first_blank .. last_blank have no measurement at all
  std::int64_t last_blank = -1;
};

void disturb(const Disturbance& disturbance, DepthFrame& frame);

}  // namespace depthmocap
