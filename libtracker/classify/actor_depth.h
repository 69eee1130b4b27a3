#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "depthmocap/image.h"

namespace depthmocap {

// The actor's depth cut out of a frame, everything else at kBackgroundDepth_m, with a border of background one pixel
// wide: a probe is clamped to the border and read, with no further question. Filled once a frame, its memory reused.
struct ActorDepth {
  int left = 0;                // [px] column of the frame that is column 1 here
  int top = 0;                 // [px] row of the frame that is row 1 here
  int width = 0;               // [px] without the border; 0 = no actor
  int height = 0;              // [px] without the border
  std::vector<float> depth_m;  // (height + 2) rows of pitch() values [m]

  [[nodiscard]] int pitch() const { return width + 2; }
  // Depth [m] at column x, row y of the cut-out with its border, any x and y.
  [[nodiscard]] float probe(int x, int y) const {
    const int column = std::clamp(x, 0, width + 1);
    const int row = std::clamp(y, 0, height + 1);
    return depth_m[static_cast<std::size_t>(row) * static_cast<std::size_t>(pitch()) +
                   static_cast<std::size_t>(column)];
  }
};

void cutOutActor(const DepthImage& depth, const MaskImage& mask, ActorDepth& actor);

// A forest's offsets are divided by the pixel's depth; nearer than this they no longer grow.
inline constexpr float kNearestProbeDepth_m = 0.1F;

// [px / (px * m)] what an offset at the reference focal length is multiplied by for a pixel at `depth_m`.
float probeScale(double focal_px, float depth_m);

// The whole pixel nearest to `offset_px`. Written so that scalar and vector code agree on every value.
inline int wholePixels(float offset_px) {
  return static_cast<int>(offset_px + 4096.5F) - 4096;
}

}  // namespace depthmocap
