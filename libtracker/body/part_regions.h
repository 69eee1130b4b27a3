#pragma once
#include <Eigen/Core>

#include "depthmocap/parts.h"
#include "libtracker/body/body_surface.h"
#include "libtracker/skeleton/skeleton.h"

namespace depthmocap {

// The part that a point [m] of a surface in the zero pose belongs to (root at the origin). One definition for every
// body: planes placed by the joints, so that each region holds the joint of its name. Mirror points get mirrored parts.
//   head      above the jaw line, which rises towards the back
//   neck      from there to the base of the neck, with the start of the trapezius
//   shoulder  from the middle of the clavicle to a quarter of the upper arm, bounded below by the line to the armpit
//   torso     chest and belly down to the navel; waist: the pelvis from there to the crease of the leg, halved at x = 0
Part partOfPoint(const Skeleton& skeleton, const Eigen::Vector3f& p);

// Sets the part of each triangle from its centre.
void labelParts(BodySurface& body);

}  // namespace depthmocap
