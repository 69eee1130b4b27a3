#include "apps/view/label_runs.h"

#include <limits>

namespace depthmocap {

LabelRuns::LabelRuns(const PartImage& labels, int step) : width_(labels.width), height_(labels.height), step_(step) {
  for (int y = 0; y < height_; y += step_) {
    for (int x = 0; x < width_; x += step_) {
      const std::uint8_t label = labels.at(x, y);
      const bool fits = !runs_.empty() && runs_.back().label == label &&
                        runs_.back().length < std::numeric_limits<std::uint16_t>::max();
      if (fits) {
        ++runs_.back().length;
      } else {
        runs_.push_back({label, 1});
      }
    }
  }
  runs_.shrink_to_fit();
}

void LabelRuns::unpack(PartImage& labels) const {
  labels.reset(width_, height_, 0);
  std::size_t run = 0;
  int used = 0;
  for (int y = 0; y < height_; y += step_) {
    for (int x = 0; x < width_; x += step_) {
      if (used == runs_[run].length) {
        ++run;
        used = 0;
      }
      labels.at(x, y) = runs_[run].label;
      ++used;
    }
  }
}

}  // namespace depthmocap
