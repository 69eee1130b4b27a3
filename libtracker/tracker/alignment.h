#pragma once
#include "depthmocap/actor.h"
#include "depthmocap/marker_set.h"
#include "depthmocap/pose.h"
#include "libtracker/skeleton/forward_kinematics.h"

namespace depthmocap {

// Where a pose puts its markers: world frame, confidence 1.
MarkerSet modelMarkers(const Actor& actor, const Pose& q, ForwardKinematics& fk);

// q with root translation and heading set so that its markers lie closest (weighted least squares) to the seen ones;
// world.
Pose placedAt(const Actor& actor, Pose q, const MarkerSet& seen_world, ForwardKinematics& fk);

// The same markers in another frame: p_to = R_to_from * p_from.
MarkerSet rotated(const Eigen::Matrix3d& R_to_from, const MarkerSet& markers_from);

}  // namespace depthmocap
