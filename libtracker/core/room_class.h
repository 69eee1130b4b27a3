#pragma once
#include <cstdint>

namespace depthmocap {

// What a pixel of a room shows. The numbers stand in label images, beside those of parts.
enum class RoomClass : std::uint8_t {
  Unknown = 0,  // not measured, or neither (what somebody carries)
  Person = 1,
  Shell = 2,  // floor, walls, ceiling
  Thing = 9,  // furniture, pets
};

}  // namespace depthmocap
