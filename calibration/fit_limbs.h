#pragma once
#include <vector>

#include "calibration/calibrator.h"
#include "calibration/pose_observation.h"
#include "depthmocap/actor.h"

namespace depthmocap {

// Cylinders to the arms and legs, an elliptic cylinder to the torso, by the clouds of all frames: each part's points
// are laid over those of the first frame.
FittedLimbs fitLimbs(const std::vector<std::vector<CloudPoint>>& clouds, const BodyOutline& outline);

// s_0 and the girths to start from: the average body of the outline's height, its limbs as thick as the cylinders, left
// and right equal.
ShapeVector startShape(const BodyTemplate& body, const BodyOutline& outline, const FittedLimbs& limbs);

// Notes the cylinders' radii.
void setRadii(const FittedLimbs& limbs, ActorMeasurement& measured);

// [0, 1] by how much of the cloud the fitted surface explains and how closely.
double fitConfidence(const JointSolution& solution);

}  // namespace depthmocap
