#pragma once
#include <Eigen/Core>
#include <array>
#include <vector>

#include "depthmocap/pose.h"
#include "libtracker/body/body_surface.h"

namespace depthmocap {

// A skin bone that turns like `bone` without its twist about `axis` (0 = x, 1 = y).
struct TwistBone {
  int untwisted;
  Bone bone;
  int axis;
  Dof twist;
};
inline constexpr std::array<TwistBone, 4> kTwistBones = {{{kRightHumerusUntwisted, Bone::RightHumerus, 0, kRhumerusRx},
                                                          {kLeftHumerusUntwisted, Bone::LeftHumerus, 0, kLhumerusRx},
                                                          {kRightFemurUntwisted, Bone::RightFemur, 1, kRfemurRy},
                                                          {kLeftFemurUntwisted, Bone::LeftFemur, 1, kLfemurRy}}};

// World positions [m] of the surface's vertices for a pose: linear blend skinning. `vertices` is resized once and
// reused; nothing is allocated when it already has the size. Safe to call from several threads with an output each.
void poseSurface(const BodySurface& body, const Pose& q, std::vector<Eigen::Vector3f>& vertices);

}  // namespace depthmocap
