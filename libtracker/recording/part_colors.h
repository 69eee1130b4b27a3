#pragma once
#include <array>
#include <cstdint>

#include "depthmocap/parts.h"

namespace depthmocap {

// The display colour of each part, RGB; left parts lean to blue and green, right parts to red and yellow.
inline constexpr std::array<std::array<std::uint8_t, 3>, kPartCount + 1> kPartColors = {{{0, 0, 0},
                                                                                         {235, 235, 235},
                                                                                         {150, 150, 150},
                                                                                         {0, 92, 230},
                                                                                         {214, 39, 40},
                                                                                         {60, 160, 255},
                                                                                         {255, 110, 90},
                                                                                         {150, 215, 255},
                                                                                         {255, 180, 160},
                                                                                         {130, 90, 180},
                                                                                         {0, 110, 90},
                                                                                         {190, 120, 0},
                                                                                         {0, 165, 120},
                                                                                         {240, 160, 20},
                                                                                         {110, 220, 170},
                                                                                         {255, 215, 100}}};

}  // namespace depthmocap
