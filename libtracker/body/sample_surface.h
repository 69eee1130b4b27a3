#pragma once
#include <cstdint>

#include "depthmocap/surface_model.h"
#include "libtracker/body/body_surface.h"

namespace depthmocap {

// About `points` points spread evenly over a body's surface by area. The same points for the same seed.
SurfaceModel sampleSurface(const BodySurface& body, int points, std::uint64_t seed);

}  // namespace depthmocap
