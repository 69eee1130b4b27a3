#pragma once
#include <array>

#include "depthmocap/parts.h"
#include "libtracker/skeleton/skeleton.h"

namespace depthmocap {

// Offsets for an uncalibrated body: shares of the bone lengths, measured once as the mean over rendered bodies.
MarkerModel averageMarkerModel(const Skeleton& skeleton);

// Mean radius [m] of each part of an average body of this size: how deep the marker lies behind the surface that a
// camera sees, used to push surface modes into the body.
std::array<double, kPartCount> averagePartRadii(const Skeleton& skeleton);

}  // namespace depthmocap
