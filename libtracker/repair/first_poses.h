#pragma once
#include <vector>

#include "libtracker/repair/marker_body.h"

namespace depthmocap {

// Poses of a sequence to start from: inverse kinematics of every keyframe by itself, turned to go on from the keyframe
// before, and straight lines between them. keyframes: indices into views, growing, at least one.
std::vector<Pose> firstPoses(const IkSolver& solver, const MarkerBody& body, const std::vector<MarkerView>& views,
                             const std::vector<double>& time_s, const std::vector<std::size_t>& keyframes, int threads);

// The frames that show at least `least` markers, at least `apart_s` apart.
std::vector<std::size_t> keyframesOf(const std::vector<MarkerView>& views, const std::vector<double>& time_s,
                                     std::size_t least, double apart_s);

}  // namespace depthmocap
