#pragma once
#include <Eigen/Core>

#include "depthmocap/parts.h"

namespace depthmocap {

// Up to 15 labelled 3D points, one per part (index = partIndex(part)); the paper's a~. Each use states the frame.
struct MarkerSet {
  Eigen::Matrix<double, 3, kPartCount> position = Eigen::Matrix<double, 3, kPartCount>::Zero();  // [m]
  // [0, 1] weight of the marker in every later term; 0 = not seen, its position is undefined.
  Eigen::Matrix<double, kPartCount, 1> confidence = Eigen::Matrix<double, kPartCount, 1>::Zero();

  [[nodiscard]] bool seen(int part_index) const { return confidence[part_index] > 0; }
  [[nodiscard]] int seenCount() const { return static_cast<int>((confidence.array() > 0).count()); }
};

}  // namespace depthmocap
