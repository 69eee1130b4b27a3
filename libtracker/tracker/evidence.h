#pragma once
#include <vector>

#include "depthmocap/marker_set.h"
#include "libtracker/core/classified_pixels.h"
#include "libtracker/match/surface_matcher.h"

namespace depthmocap {

// The measurements of one person in one image, under the assumption that the camera sees one side of the person: the
// input of the fit. Another assumed side gives another Evidence.
struct Evidence {
  ClassifiedPixels pixels;             // (1)
  MarkerSet markers_camera;            // (2) [m]
  MarkerSet markers_world;             // the same [m]
  std::vector<SurfaceSample> samples;  // of the depth, for the dense term; world
};

}  // namespace depthmocap
