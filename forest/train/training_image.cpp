#include "forest/train/training_image.h"

#include <algorithm>

#include "depthmocap/parts.h"

namespace depthmocap {

void mirrorImage(TrainingImage& image) {
  if (image.facing) image.facing = mirrored(*image.facing);
  for (int y = 0; y < image.depth.height; ++y) {
    float* depth = image.depth.data.data() + image.depth.index(0, y);
    std::reverse(depth, depth + image.depth.width);
    std::uint8_t* labels = image.labels.data.data() + image.labels.index(0, y);
    std::reverse(labels, labels + image.labels.width);
  }
  for (std::uint8_t& label : image.labels.data) {
    if (label != 0) label = static_cast<std::uint8_t>(mirrored(static_cast<Part>(label)));
  }
}

}  // namespace depthmocap
