#pragma once
#include <vector>

#include "libtracker/body/body_surface.h"
#include "libtracker/body/makehuman_files.h"

namespace depthmocap {

// Brings a morphed MakeHuman mesh from its A-pose with bent elbows into our zero pose: bone lengths are the means of
// left and right, each bone is turned onto its axis, and the skin follows with the rig's weights. Fills skeleton,
// vertices and skin; triangles and parts stay empty. stature_m > 0 scales the result to that height [m]. Throws Error
// when the rig lacks a bone.
BodySurface inZeroPose(const std::vector<Eigen::Vector3f>& vertices, const MakeHumanJoints& joints,
                       const std::vector<BoneWeights>& weights, double stature_m);

}  // namespace depthmocap
