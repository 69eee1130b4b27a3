#pragma once
#include "apps/track/collected_motion.h"
#include "apps/track/track_options.h"

namespace depthmocap {

// Joint centres as markers (TRC, C3D) and OpenSim coordinates (.mot), as the options ask: a file for each person who
// was seen, all moved by the same translation so that `origin_world` [m] is the origin. `fps` of the recording [1/s] (>
// 0). Error where a file cannot be written.
void writeLaboratoryFiles(const TrackOptions& options, const CollectedMotion& motion,
                          const Eigen::Vector3d& origin_world, double fps);

}  // namespace depthmocap
