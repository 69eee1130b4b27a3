#pragma once
#include "libtracker/body/body_field.h"
#include "libtracker/body/body_surface.h"

namespace depthmocap {

// Vertices and triangles (counter-clockwise from outside, closed) of the field's zero level on a grid of this cell
// size [m] that has a plane at x = 0: flying edges (Schroeder et al. 2015).
void polygonise(const BodyField& field, double cell, BodySurface& surface);

}  // namespace depthmocap
