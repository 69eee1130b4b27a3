#include "libtracker/tracker/frame_evidence.h"

#include "libtracker/tracker/tracker_impl.h"

namespace depthmocap {

const NormalEquations& FrameEvidence::of(const Tracker& tracker, int person) {
  return tracker.impl_->person(person).evidence;
}

}  // namespace depthmocap
