#pragma once
#include <string>
#include <vector>

#include "libtracker/skeleton/skeleton.h"

namespace depthmocap {

// A motion on the 36-DoF body: retargeted motion capture or a procedural motion. World: y up, metres.
struct MotionClip {
  std::string name;         // "16_32", "walk"
  double fps = 30.0;        // [1/s]
  BoneLengths lengths;      // the performer's
  std::vector<Pose> poses;  // one per frame
};

}  // namespace depthmocap
