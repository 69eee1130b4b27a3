#pragma once
#include <memory>

#include "libtracker/sensor/depth_source.h"

namespace depthmocap {

// A source as if its camera hung upright: pictures and camera turned clockwise by `turn_deg` (0, 90, 180 or 270). 0:
// the source itself.
std::unique_ptr<DepthSource> turnedSource(std::unique_ptr<DepthSource> source, int turn_deg);

}  // namespace depthmocap
