#pragma once
#include <Eigen/Core>
#include <vector>

#include "libtracker/body/body_surface.h"
#include "libtracker/skeleton/dof.h"

namespace depthmocap {

// World positions [m] of the surface's vertices for a pose: linear blend skinning. `vertices` is resized once and
// reused; nothing is allocated when it already has the size. Safe to call from several threads with an output each.
void poseSurface(const BodySurface& body, const Pose& q, std::vector<Eigen::Vector3f>& vertices);

}  // namespace depthmocap
