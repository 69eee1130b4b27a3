#pragma once
#include <vector>

#include "depthmocap/marker_set.h"
#include "libtracker/core/classified_pixels.h"
#include "libtracker/match/surface_matcher.h"

namespace depthmocap {

// What one image says of one person, seen from one side: the input of the fit. Supposing that the camera sees another
// side gives another Evidence.
struct Evidence {
  ClassifiedPixels pixels;             // (1)
  MarkerSet markers_camera;            // (2) [m]
  MarkerSet markers_world;             // the same [m]
  std::vector<SurfaceSample> samples;  // of the depth, for the dense term; world
};

}  // namespace depthmocap
