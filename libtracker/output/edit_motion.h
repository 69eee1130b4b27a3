#pragma once
#include "libtracker/output/motion_track.h"

namespace depthmocap {

// What animators do with a clip before they use it.

// The motion at another rate [1/s] (> 0), from the first frame's time on: rotations by slerp, the rest linearly. The
// last frame is the last one that the motion reaches.
MotionTrack resampled(const MotionTrack& track, double fps);

// Treads on the spot: the hips stay above x = z = 0. Heights and turns remain.
void keepInPlace(MotionTrack& track);

// Makes the pose of the last frame that of the first: the difference is taken away little by little over the last
// kLoopBlend_s seconds (half the clip where it is shorter). Where the actor stands and faces goes on, so that a walk
// walks on; with `and_place` it comes back as well.
void closeLoop(MotionTrack& track, bool and_place);

inline constexpr double kLoopBlend_s = 0.5;  // [s] about one step of an easy walk

}  // namespace depthmocap
