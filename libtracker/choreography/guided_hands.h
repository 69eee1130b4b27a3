#pragma once
#include <vector>

#include "libtracker/choreography/arm_ik.h"
#include "libtracker/choreography/body_frame.h"
#include "libtracker/core/random.h"

namespace depthmocap {

// Hands led along lines in the air by a body that stands still.

// A closed curve run through several times, by the right hand or both.
struct Orbit {
  HandTarget center{};
  double out = 0.0, up = 0.0, forward = 0.0;  // [m] radii
  double up_frequency = 1.0;
  double up_phase = 0.25;  // [cycles]
  double round_s = 1.6;
  double rounds = 2.5;
  bool both = false;
  double apart = 0.0;   // [cycles] the left hand is before the right
  double follow = 0.0;  // [0, 1] how far trunk and head follow, as in guideHand()
};
BodyFrames followOrbit(const Skeleton& skeleton, const Orbit& orbit, Random& random);

// Straight strokes of the right hand from point to point, each from rest to rest.
struct Strokes {
  struct Point {
    double right, up;  // [-1, 1] on the drawing plane
  };
  HandTarget center{};               // of the plane, which stands across the body
  double width = 0.2, height = 0.2;  // [m] half the size of the plane
  double stroke_s = 0.5;
  double follow = 0.0;
  std::vector<Point> points{};  // two or more
};
BodyFrames followStrokes(const Skeleton& skeleton, const Strokes& strokes, Random& random);

}  // namespace depthmocap
