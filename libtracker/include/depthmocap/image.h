#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

namespace depthmocap {

// A dense row-major image of plain values. Copies copy; at() does not check bounds (contains() does).
template <typename T>
struct Image {
  int width = 0;   // [px]
  int height = 0;  // [px]
  std::vector<T> data;

  Image() = default;
  Image(int w, int h, T value = T{})
      : width(w), height(h), data(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), value) {}

  [[nodiscard]] bool contains(int x, int y) const { return x >= 0 && y >= 0 && x < width && y < height; }
  [[nodiscard]] bool empty() const { return data.empty(); }
  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
  T& at(int x, int y) { return data[index(x, y)]; }
  const T& at(int x, int y) const { return data[index(x, y)]; }

  // Resizes and fills; keeps the capacity, so that a loop over frames of one size does not allocate.
  void reset(int w, int h, T value) {
    width = w;
    height = h;
    data.assign(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), value);
  }
};

// Distance along the optical axis [m]; 0 = no measurement; never NaN, never negative.
using DepthImage = Image<float>;
// A Part per pixel (core/parts.h); 0 = no person.
using PartImage = Image<std::uint8_t>;
// 1 where the pixel belongs to the tracked actor, 0 elsewhere.
using MaskImage = Image<std::uint8_t>;

}  // namespace depthmocap
