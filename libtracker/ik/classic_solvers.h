#pragma once
#include "depthmocap/ik_result.h"
#include "depthmocap/joint_targets.h"
#include "libtracker/skeleton/skeleton.h"

namespace depthmocap {

// The classic solvers on the whole body with several end effectors: every target counts alike, also those inside a
// chain. q: where to start, within joint limits; they stay within them. Each stops where it comes no closer.

// Damped least squares: dq = J^T (J J^T + lambda^2 I)^-1 e (Wampler 1986; Nakamura and Hanafusa 1986).
IkResult solveDampedLeastSquares(const Skeleton& skeleton, const JointTargets& targets, const Pose& q);

// Cyclic coordinate descent (Wang and Chen 1991): one DoF after the other, from the hands and feet inwards, turns to
// where the joints that it moves lie nearest to their targets.
IkResult solveCyclicDescent(const Skeleton& skeleton, const JointTargets& targets, const Pose& q);

// FABRIK (Aristidou and Lasenby 2011) on the tree of the body, with the pelvis and the shoulder girdle as rigid pieces
// with several children, and with joint limits: inwards each joint is placed at its bone's length from the one that was
// placed before; outwards every bone turns, within its limits, to where its joints should be.
IkResult solveFabrik(const Skeleton& skeleton, const JointTargets& targets, const Pose& q);

}  // namespace depthmocap
