#pragma once
#include <optional>

#include "depthmocap/tracker.h"

namespace depthmocap {

// For measurements (tests/accuracy/experiment.cpp): ground truth that replaces the output of a stage, to attribute
// error to stages. Known part labels need no such door: they are a PartClassifier.
struct TrackerMeasurement {
  // Markers [m], camera frame, that the next frames take instead of those found; none: the tracker's own.
  static void setMarkers(Tracker& tracker, const std::optional<MarkerSet>& markers_camera);
};

}  // namespace depthmocap
