#pragma once
#include <cstdint>

namespace depthmocap {

// Labels of several people in one image are part + kLabelsAPerson * (id - 1), id from 1.
inline constexpr int kLabelsAPerson = 16;

constexpr std::uint8_t labelOf(std::uint8_t part, int id) {
  return part == 0 ? part : static_cast<std::uint8_t>(part + kLabelsAPerson * (id - 1));
}
constexpr std::uint8_t partOfPerson(std::uint8_t label) {
  return static_cast<std::uint8_t>(label % kLabelsAPerson);
}

}  // namespace depthmocap
