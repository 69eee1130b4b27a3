#pragma once
#include <Eigen/Core>

#include "depthmocap/image.h"

namespace depthmocap {

// The actor's outline in one depth image: for any place in the image the nearest pixel of the actor. On a grid of every
// kStep-th pixel; fractions of that do not matter to a body. Reuse one object: nothing is allocated after its first
// calls.
class Silhouette {
 public:
  static constexpr int kStep = 4;  // [px]

  // `mask`: the actor's pixels.
  void observe(const MaskImage& mask);
  [[nodiscard]] bool empty() const { return empty_; }
  // The actor's pixel that is nearest to (u, v), to about kStep pixels; (u, v) in the image. Not if empty().
  [[nodiscard]] Eigen::Vector2i nearest(int u, int v) const;

 private:
  void take(int x, int y, int from_x, int from_y);

  bool empty_ = true;
  Image<Eigen::Vector2i> nearest_;  // [cells] of each cell
};

}  // namespace depthmocap
