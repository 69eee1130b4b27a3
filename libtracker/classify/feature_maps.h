#pragma once
#include <cstddef>
#include <vector>

namespace depthmocap {

// Several images of one size, one after the other. Rows have room for whole vectors: what is written beyond their width
// means nothing.
class FeatureMaps {
 public:
  static constexpr int kVector = 16;  // [px] rows have room for a multiple of this

  // Keeps its memory, and where the size is the same one its values.
  void resize(int maps, int width, int height);

  [[nodiscard]] int maps() const { return maps_; }
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] float* row(int map, int y) { return data_.data() + offset(map, y); }
  [[nodiscard]] const float* row(int map, int y) const { return data_.data() + offset(map, y); }

 private:
  [[nodiscard]] std::ptrdiff_t offset(int map, int y) const {
    return (static_cast<std::ptrdiff_t>(map) * height_ + y) * pitch_;
  }

  int maps_ = 0;
  int width_ = 0;
  int height_ = 0;
  std::ptrdiff_t pitch_ = 0;
  std::vector<float> data_;
};

}  // namespace depthmocap
