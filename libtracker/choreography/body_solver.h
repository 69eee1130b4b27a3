#pragma once
#include <Eigen/Core>
#include <array>

#include "depthmocap/pose.h"
#include "libtracker/choreography/body_frame.h"
#include "libtracker/skeleton/skeleton.h"

namespace depthmocap {

// The sole, in the foot bone's frame [m]: below the toe joint and the heel. A flat foot has both on the floor.
struct Sole {
  double ankle_height;
  Eigen::Vector3d toe;   // toe joint
  Eigen::Vector3d ball;  // floor point below the toe joint
  Eigen::Vector3d heel;
};
Sole soleOf(const Skeleton& skeleton);

// Height [m] of the pelvis when standing with straight legs.
double standingPelvisHeight(const Skeleton& skeleton);

// Ankle in the world [m] of a foot at this pitch [rad].
Eigen::Vector3d anklePosition(const Sole& sole, const FootState& foot, double pitch);

// The pose of a frame: trunk and arms as given, legs by analytic two-bone IK to the feet. A leg that is too short first
// lifts its heel by up to heel_rise, then misses. The result is within jointLimits().
Pose solveBody(const Skeleton& skeleton, const BodyFrame& frame);

// The highest pelvis.y at which every foot on the ground can be reached with its heel up by at most heel_rise;
// +infinity in the air.
double highestPelvis(const Skeleton& skeleton, const BodyFrame& frame);

// Centre of mass in the world [m] (segment masses of de Leva 1996).
Eigen::Vector3d centerOfMass(const Skeleton& skeleton, const Pose& q);

}  // namespace depthmocap
