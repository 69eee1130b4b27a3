#pragma once
#include "libtracker/choreography/body_frame.h"

namespace depthmocap {

// A body in the air on a parabola, which afterwards stands elsewhere.
struct Flight {
  double start_s = 0.0;
  double height = 0.0;                   // [m]
  double tuck = 0.0;                     // [m] the feet are pulled up
  double sideways = 0.0, forward = 0.0;  // [m]
  double turn = 0.0;                     // [rad]
};

// How long [s] a body flies that rises this high [m].
double airTime(double height);

// Puts a flight on frames; those after it are moved and turned.
void fly(const Flight& flight, BodyFrames& frames);

}  // namespace depthmocap
