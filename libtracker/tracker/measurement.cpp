#include "libtracker/tracker/measurement.h"

#include "libtracker/tracker/tracker_impl.h"

namespace depthmocap {

void TrackerMeasurement::setMarkers(Tracker& tracker, const std::optional<MarkerSet>& markers_camera) {
  tracker.impl_->people.front()->observer.overrideMarkers(markers_camera);
}

}  // namespace depthmocap
