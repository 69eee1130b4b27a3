#pragma once
#include "depthmocap/tracker.h"
#include "libtracker/skeleton/normal_equations.h"

namespace depthmocap {

// What each frame said of its pose by itself, for those who join frames (ClipSmoother). No part of the public Tracker.
struct FrameEvidence {
  // About the pose of the person in the last frame, whose state is TrackState::Tracking. Throws Error where there is no
  // such person. Valid until the next frame.
  static const NormalEquations& of(const Tracker& tracker, int person);
};

}  // namespace depthmocap
