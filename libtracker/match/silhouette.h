#pragma once
#include <Eigen/Core>
#include <cstdint>

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
  [[nodiscard]] bool empty() const { return first_column_ > last_column_; }
  // The actor's pixel that is nearest to (u, v), to about kStep pixels; (u, v) in the image. Not if empty().
  [[nodiscard]] Eigen::Vector2i nearest(int u, int v) const;

 private:
  static constexpr std::int16_t kNone = -1;
  void fillColumn(int x);

  Image<std::int16_t> nearest_row_;  // [cells] for each cell, of the actor's cells in its column; kNone: none
  int first_column_ = 0;             // [cells] the actor's
  int last_column_ = -1;
};

}  // namespace depthmocap
