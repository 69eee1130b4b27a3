#pragma once
#include <cstddef>
#include <optional>
#include <string>

#include "depthmocap/image.h"
#include "libtracker/core/facing.h"

namespace depthmocap {

// One picture to learn from or to measure on. Both images have the same size.
struct TrainingImage {
  DepthImage depth;     // [m] of the actor alone; 0 elsewhere
  PartImage labels;     // Part; 0 = not known or not the actor: never sampled, though its depth is seen by probes
  double focal_px = 0;  // [px] fx of the camera (> 0)
  std::optional<Facing> facing;  // the side of the actor that is seen, where known
};

// Where pictures come from. render() is a pure function of i: the trainer asks again for what it cannot keep in memory.
// It is called from several threads at once. Throws Error where a picture cannot be had.
class TrainingImageSource {
 public:
  virtual ~TrainingImageSource() = default;
  [[nodiscard]] virtual std::size_t count() const = 0;
  virtual void render(std::size_t i, TrainingImage& image) = 0;
  // One line that changes whenever the pictures do: data, seeds, options.
  [[nodiscard]] virtual std::string description() const = 0;
};

// The picture in a mirror: columns reversed, left and right parts and facings swapped.
void mirrorImage(TrainingImage& image);

}  // namespace depthmocap
