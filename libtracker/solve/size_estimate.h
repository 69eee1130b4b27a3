#pragma once
#include "depthmocap/marker_set.h"
#include "libtracker/skeleton/forward_kinematics.h"
#include "libtracker/skeleton/marker_model.h"

namespace depthmocap {

// How much larger than the skeleton the actor is, by one frame.
struct SizeEstimate {
  double scale = 1.0;    // (> 0) multiplies every bone length; 1 if it cannot be told
  double spread_m2 = 0;  // [m^2] weighted squared extent of the markers used: the weight of this frame against others
  bool valid = false;    // false: fewer than 4 markers, or all in one place
};

// Least-squares uniform scale of the model's markers about their centroid that best meets the seen ones, in closed
// form, reweighted a few times by the Lorentzian's influence (sigma_m [m]) so that stray markers do not count. `fk`:
// the solved pose of the skeleton that the marker model belongs to; markers in the same world.
SizeEstimate estimateSize(const ForwardKinematics& fk, const MarkerModel& model, const MarkerSet& markers_world,
                          double sigma_m = 0.05);

}  // namespace depthmocap
