#pragma once
#include <vector>

#include "libtracker/ik/ik_solver.h"
#include "libtracker/ik/image_term.h"
#include "libtracker/ik/pose_sequence.h"

namespace depthmocap {

// The pose whose joints are seen at the targets, after section 5 of MNN-IK; by IkMethod::Lm and the solver's prior,
// which decides what a picture leaves open: the depth of each joint. Orthographic: the root's depth is 0. residual_m is
// the distance in the picture at the body's size. Error where there are fewer than kLeastImageTargets, or where they
// are no upright person's.
IkResult solveImage(const IkSolver& solver, const ImageProjection& projection, const ImageTargets& targets);

// The poses of successive pictures at these times, all at once (solveSequence). From several pictures, each solved by
// itself, the sequence is followed both ways; the best of these goes on: what one picture leaves open another may tell.
std::vector<IkResult> solveImageSequence(const IkSolver& solver, const ImageProjection& projection,
                                         const std::vector<ImageTargets>& targets, const std::vector<double>& time_s,
                                         const SequenceConfig& config);

}  // namespace depthmocap
