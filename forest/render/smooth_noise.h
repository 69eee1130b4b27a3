#pragma once
#include <vector>

#include "libtracker/core/random.h"

namespace depthmocap {

// A random field over an image that changes slowly: standard normal values on a square lattice, bilinear between. Mean
// 0, standard deviation 1 on average over the image.
class SmoothNoise {
 public:
  // New values for a width x height [px] image with the lattice's `spacing` [px] (>= 1). Keeps its memory.
  void draw(int width, int height, double spacing, Random& random);
  // At a pixel inside the image.
  [[nodiscard]] float at(int x, int y) const;

 private:
  std::vector<float> lattice_;
  int columns_ = 0;
  float pitch_ = 1.0F;  // lattice cells a pixel
};

}  // namespace depthmocap
