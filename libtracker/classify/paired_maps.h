#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "libtracker/classify/feature_maps.h"

namespace depthmocap {

// The input of a convolution in whole numbers: their sums are the same in any order, so every vector unit gives the
// same bits. The values of two maps at a pixel are the halves of one number, the first map's the lower one: one
// instruction multiplies both and adds the products. A border of zeros saves convolutions asking where the image ends.
// For a stride of 2, even and odd columns are maps of their own, so that neighbouring outputs read neighbours.
class PairedMaps {
 public:
  static constexpr int kBorder = 2;  // [px] on each side: half of the largest kernel, or a dilation of 2
  // Largest absolute value: 13 bits, so that with weights of about 10 bits the sum of 500 products fits into 31.
  static constexpr int kMost = 8191;

  // `stride` 1 or 2; values are finite. Keeps its memory.
  void fill(const FeatureMaps& maps, int stride);

  // What 1 stands for.
  [[nodiscard]] float unit() const { return unit_; }
  // Pairs of the even columns, or of all; of a stride of 2 those of the odd columns follow.
  [[nodiscard]] int pairs() const { return pairs_; }
  // Pixel 0 of a row; y in [-kBorder, height + kBorder), pixels from -kBorder on.
  [[nodiscard]] const std::int32_t* row(int pair, int y) const { return data_.data() + offset(pair, y); }
  [[nodiscard]] std::ptrdiff_t pairSize() const { return pitch_ * (height_ + 2 * kBorder); }

 private:
  [[nodiscard]] std::ptrdiff_t offset(int pair, int y) const {
    return pair * pairSize() + (y + kBorder) * pitch_ + kBorder;
  }
  void resize(int pairs, int width, int height, int stride);

  int pairs_ = 0;
  int width_ = 0;
  int height_ = 0;
  int stride_ = 0;
  std::ptrdiff_t pitch_ = 0;
  float unit_ = 0;
  std::vector<std::int32_t> data_;
};

}  // namespace depthmocap
