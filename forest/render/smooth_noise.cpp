#include "forest/render/smooth_noise.h"

#include <cmath>
#include <cstddef>

namespace depthmocap {
namespace {

// Bilinear mixing of independent values keeps (2/3)^2 of their variance on average.
constexpr double kVarianceGain = 1.5;

}  // namespace

void SmoothNoise::draw(int width, int height, double spacing, Random& random) {
  columns_ = static_cast<int>(std::ceil(width / spacing)) + 1;
  const int rows = static_cast<int>(std::ceil(height / spacing)) + 1;
  pitch_ = static_cast<float>(1.0 / spacing);
  lattice_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows));
  for (float& value : lattice_) value = static_cast<float>(kVarianceGain * random.normal());
}

float SmoothNoise::at(int x, int y) const {
  const float u = static_cast<float>(x) * pitch_;
  const float v = static_cast<float>(y) * pitch_;
  const int column = static_cast<int>(u);
  const int row = static_cast<int>(v);
  const float a = u - static_cast<float>(column);
  const float b = v - static_cast<float>(row);
  const float* p = lattice_.data() + static_cast<std::size_t>(row * columns_ + column);
  const float* q = p + columns_;
  return (1.0F - b) * ((1.0F - a) * p[0] + a * p[1]) + b * ((1.0F - a) * q[0] + a * q[1]);
}

}  // namespace depthmocap
