#pragma once
#include <array>
#include <cstdint>

#include "libtracker/segment/segment.h"

namespace depthmocap {

// The display colour of each of several people by number, RGB: told apart by those who do not see all colours, too, and
// light enough for a dark scene.
inline constexpr std::array<std::array<std::uint8_t, 3>, kMostPeople> kPersonColors = {
    {{86, 180, 233}, {230, 159, 0}, {0, 190, 140}, {240, 228, 66}, {224, 140, 190}, {235, 110, 50}}};

}  // namespace depthmocap
