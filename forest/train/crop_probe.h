#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "forest/train/image_store.h"
#include "forest/train/split_search.h"
#include "libtracker/classify/actor_depth.h"
#include "libtracker/classify/forest.h"

namespace depthmocap {

// Depth [mm] at an offset from a pixel whose offsets are scaled by `scale`: the classifier's probe.
inline std::uint16_t probeCrop_mm(const ImageCrop& crop, int x, int y, float scale, const ProbeOffset& offset) {
  const int column = std::clamp(x + wholePixels(static_cast<float>(offset[0]) * scale), 0, crop.width + 1);
  const int row = std::clamp(y + wholePixels(static_cast<float>(offset[1]) * scale), 0, crop.height + 1);
  return crop.depth_mm[static_cast<std::size_t>(row) * static_cast<std::size_t>(crop.pitch()) +
                       static_cast<std::size_t>(column)];
}

// [px / (px * m)] scale of the offsets of a pixel (with measurement) of the crop, in coordinates with the border.
inline float probeScaleAt(const ImageCrop& crop, int x, int y) {
  const std::uint16_t depth_mm =
      crop.depth_mm[static_cast<std::size_t>(y) * static_cast<std::size_t>(crop.pitch()) + static_cast<std::size_t>(x)];
  return probeScale(crop.focal_px, static_cast<float>(depth_mm) * 0.001F);
}

// The depths [mm] at all offsets from one pixel, to `probes_mm`.
void readProbesOfPixel(const ImageCrop& crop, int x, int y, const std::vector<ProbeOffset>& offsets,
                       std::uint16_t* probes_mm);

// Whether the pixel goes to the right child.
inline bool goesRight(const ImageCrop& crop, int x, int y, const ForestNode& split) {
  const float scale = probeScaleAt(crop, x, y);
  const int feature_mm = probeCrop_mm(crop, x, y, scale, split.u) - probeCrop_mm(crop, x, y, scale, split.v);
  return feature_mm >= static_cast<int>(std::lround(split.threshold_m * 1000.0F));
}

}  // namespace depthmocap
