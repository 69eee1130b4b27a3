#include "libtracker/classify/paired_maps.h"

#include <algorithm>
#include <bit>

namespace depthmocap {
namespace {

// To the nearest: the same on every machine, and by instructions that every vector unit has.
std::int32_t rounded(float value) {
  constexpr int kShift = PairedMaps::kMost + 1;
  return static_cast<std::int32_t>(value + (kShift + 0.5F)) - kShift;
}

std::int32_t paired(float a, float b) {
  return static_cast<std::int32_t>((static_cast<std::uint32_t>(rounded(b)) << 16U) |
                                   (static_cast<std::uint32_t>(rounded(a)) & 0xFFFFU));
}

// Absolute values of floats are ordered as their bits are; whole numbers are compared by vectors.
float largest(const FeatureMaps& maps) {
  std::int32_t most = 0;
  for (int m = 0; m < maps.maps(); ++m) {
    for (int y = 0; y < maps.height(); ++y) {
      const float* row = maps.row(m, y);
      for (int x = 0; x < maps.width(); ++x) most = std::max(most, std::bit_cast<std::int32_t>(row[x]) & 0x7FFFFFFF);
    }
  }
  return std::bit_cast<float>(most);
}

void pairColumns(const float* a, const float* b, int count, float scale, std::int32_t* to) {
  for (int x = 0; x < count; ++x) to[x] = paired(a[x] * scale, b[x] * scale);
}

void pairEverySecond(const float* a, const float* b, int count, float scale, std::int32_t* to) {
  for (int x = 0; x < count; ++x) to[x] = paired(a[2 * x] * scale, b[2 * x] * scale);
}

}  // namespace

void PairedMaps::resize(int pairs, int width, int height, int stride) {
  if (pairs == pairs_ && width == width_ && height == height_ && stride == stride_) return;
  pairs_ = pairs;
  width_ = width;
  height_ = height;
  stride_ = stride;
  const int columns = (width + stride - 1) / stride;
  const int room = (columns + FeatureMaps::kVector - 1) / FeatureMaps::kVector * FeatureMaps::kVector;
  pitch_ = room + 2 * kBorder;
  data_.assign(static_cast<std::size_t>(stride * pairs * pairSize() + FeatureMaps::kVector), 0);
}

void PairedMaps::fill(const FeatureMaps& maps, int stride) {
  resize((maps.maps() + 1) / 2, maps.width(), maps.height(), stride);
  const float most = largest(maps);
  unit_ = most / static_cast<float>(kMost);
  const float scale = most > 0 ? static_cast<float>(kMost) / most : 0.0F;
  for (int p = 0; p < pairs_; ++p) {
    const int second = std::min(2 * p + 1, maps.maps() - 1);  // of an odd number the last stands twice: its weight is 0
    for (int y = 0; y < height_; ++y) {
      const float* a = maps.row(2 * p, y);
      const float* b = maps.row(second, y);
      if (stride == 1) {
        pairColumns(a, b, width_, scale, data_.data() + offset(p, y));
        continue;
      }
      pairEverySecond(a, b, (width_ + 1) / 2, scale, data_.data() + offset(p, y));
      pairEverySecond(a + 1, b + 1, width_ / 2, scale, data_.data() + offset(pairs_ + p, y));
    }
  }
}

}  // namespace depthmocap
