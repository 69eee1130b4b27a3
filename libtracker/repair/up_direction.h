#pragma once
#include "libtracker/repair/repair.h"

namespace depthmocap {

// The rotation from the file's frame to the world (y up). Up is config.up, else the axis along which heads and
// shoulders are above feet and knees, or the hips, through most of the sequence; else config.usual_up.
Eigen::Matrix3d worldFromFile(const MarkerSequence& markers, const MarkerBody& body, const RepairConfig& config);

}  // namespace depthmocap
