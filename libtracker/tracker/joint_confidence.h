#pragma once
#include "depthmocap/joints.h"
#include "depthmocap/marker_set.h"

namespace depthmocap {

// Confidence of each joint in [0, 1] from the markers of the parts that meet there: the best of their confidences, each
// lowered by the marker's distance to the solved pose. 0 where none of those parts was seen.
Eigen::Matrix<double, kJointCount, 1> jointConfidence(const MarkerSet& seen, const MarkerSet& solved);

}  // namespace depthmocap
