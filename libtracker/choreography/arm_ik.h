#pragma once
#include <Eigen/Core>

#include "libtracker/choreography/body_frame.h"
#include "libtracker/skeleton/skeleton.h"

namespace depthmocap {

// A place for the wrist [m], relative to the shoulder's place in the T-pose, in the frame of the upper back.
struct HandTarget {
  double out = 0.10;  // away from the middle of the body
  double up = -0.52;
  double forward = 0.06;
  double elbow = 0.0;  // [rad] turns the elbow about the line shoulder-wrist; > 0 lifts it outwards
};

// Analytic two-bone IK of one arm. The clavicle follows the raised arm (scapulohumeral rhythm, Inman et al. 1944), the
// elbow lies where relaxed people hold it, turned by target.elbow and, where the humerus' limits ask for it, by a
// little more. A target out of reach is moved to the nearest distance from the shoulder that the arm has.
ArmAngles reachArm(const Skeleton& skeleton, const HandTarget& target);

// A swinging arm without a target: shoulder flexion forward, abduction outwards and elbow flexion [rad], from hanging
// down.
ArmAngles swingArm(double flexion, double abduction, double elbow_flexion);

// Wrist [m] in the frame of HandTarget (out, up, forward) for these angles: forward kinematics of reachArm.
Eigen::Vector3d wristOf(const Skeleton& skeleton, const ArmAngles& arm);

}  // namespace depthmocap
