#pragma once
#include <cstdint>
#include <vector>

#include "depthmocap/image.h"

namespace depthmocap {

// A label image at every step-th pixel as runs of equal labels: a few kilobytes a frame, so that a whole recording's
// labels can be kept.
class LabelRuns {
 public:
  LabelRuns() = default;
  LabelRuns(const PartImage& labels, int step);
  // The image at its full size; only every step-th pixel is set.
  void unpack(PartImage& labels) const;

 private:
  struct Run {
    std::uint8_t label;
    std::uint16_t length;
  };
  int width_ = 0;
  int height_ = 0;
  int step_ = 1;
  std::vector<Run> runs_;
};

}  // namespace depthmocap
