#pragma once
#include "apps/track/collected_motion.h"
#include "apps/track/track_options.h"

namespace depthmocap {

// The motion as BVH, glTF and USD, as the options ask. Of several people each has a BVH file of its own (M-1.bvh,
// M-2.bvh, ...), and all are in one glTF or USD file; their places in one room are kept. `people` are those of
// `tracks`, whose origin is that of the files. `fps` of the recording [1/s] (> 0). Error where a file cannot be
// written.
void writeAnimationFiles(const TrackOptions& options, const CollectedMotion& motion,
                         const std::vector<const CollectedMotion::Person*>& people,
                         const std::vector<MotionTrack>& tracks, double fps);

}  // namespace depthmocap
