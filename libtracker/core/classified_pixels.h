#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "depthmocap/parts.h"
#include "libtracker/core/facing.h"

namespace depthmocap {

// The classifier's answer for every classified pixel of the actor, in row order.
struct ClassifiedPixels {
  struct Pixel {
    std::int16_t x = 0;                           // [px]
    std::int16_t y = 0;                           // [px]
    float depth_m = 0;                            // [m]
    std::array<float, kPartCount> probability{};  // over the 15 parts, sums to 1
  };
  int stride = 1;  // [px] every stride-th pixel in x and y was classified
  std::vector<Pixel> pixels;
  // Probability of each side being the one that is seen; all equal where the classifier does not know.
  FacingShares facing = {0.25F, 0.25F, 0.25F, 0.25F};
  FacingShares facing_by_image = {0.25F, 0.25F, 0.25F, 0.25F};  // the same without what was known before
};

}  // namespace depthmocap
