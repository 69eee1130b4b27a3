#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

namespace depthmocap {

// What a coarse grid over an image shows. Cell (cx, cy) is pixel (cx * stride + offset, cy * stride + offset).
struct RoomMap {
  int stride = 1;  // [px]
  int offset = 0;  // [px]
  int width = 0;   // [cells]
  int height = 0;  // [cells]
  // One per cell, row by row: how much more speaks for one answer than for the best other one, as a logarithm of odds.
  std::vector<float> person;
  std::vector<float> shell;            // floor, walls, ceiling
  std::vector<std::uint8_t> measured;  // 0: nothing is known, the values above are 0

  [[nodiscard]] std::size_t index(int cx, int cy) const {
    return static_cast<std::size_t>(cy) * static_cast<std::size_t>(width) + static_cast<std::size_t>(cx);
  }
};

}  // namespace depthmocap
