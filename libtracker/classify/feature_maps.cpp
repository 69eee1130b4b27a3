#include "libtracker/classify/feature_maps.h"

namespace depthmocap {

void FeatureMaps::resize(int maps, int width, int height) {
  if (maps == maps_ && width == width_ && height == height_) return;
  maps_ = maps;
  width_ = width;
  height_ = height;
  pitch_ = (width + kVector - 1) / kVector * kVector;
  data_.assign(static_cast<std::size_t>(offset(maps, 0)), 0.0F);
}

}  // namespace depthmocap
