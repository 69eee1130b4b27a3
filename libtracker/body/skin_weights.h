#pragma once
#include <Eigen/Core>
#include <array>

#include "libtracker/body/body_surface.h"
#include "libtracker/skeleton/skeleton.h"

namespace depthmocap {

// Weight of every skin bone for one vertex; any scale.
using DenseWeights = std::array<double, kSkinBoneCount>;

// The four heaviest entries, heaviest first, scaled to the sum 1. At least one weight must be positive.
BodySurface::Skin packedWeights(const DenseWeights& weights);

// Moves the share of the upper arms' and thighs' weight that lies near the body to their untwisted bones.
// `p`: the vertex in the zero pose [m].
void splitTwist(const Skeleton& skeleton, const Eigen::Vector3d& p, DenseWeights& weights);

// Share of the trunk that turns with the upper back, not with the root, at a height [m] of the zero pose.
double upperBackShare(const BoneLengths& lengths, double y);

// Weights from where a vertex of the zero pose [m] lies between the joints: smooth steps across planes at each joint.
// The T-pose keeps limbs apart, so nothing leaks from leg to leg or from arm to trunk.
BodySurface::Skin skinOfPoint(const Skeleton& skeleton, const Eigen::Vector3f& p);

}  // namespace depthmocap
