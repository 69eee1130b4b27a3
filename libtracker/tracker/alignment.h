#pragma once
#include "depthmocap/marker_set.h"
#include "depthmocap/pose.h"
#include "libtracker/skeleton/forward_kinematics.h"
#include "libtracker/tracker/actor_model.h"

namespace depthmocap {

// Where a pose puts its markers: world frame, confidence 1.
MarkerSet modelMarkers(const ActorModel& actor, const Pose& q, ForwardKinematics& fk);

// q with root translation and heading set so that its markers lie closest (weighted least squares) to the seen ones;
// world.
Pose placedAt(const ActorModel& actor, Pose q, const MarkerSet& seen_world, ForwardKinematics& fk);

// The same markers in another frame: p_to = R_to_from * p_from.
MarkerSet rotated(const Eigen::Matrix3d& R_to_from, const MarkerSet& markers_from);

}  // namespace depthmocap
