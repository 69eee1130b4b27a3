#pragma once
#include "libtracker/marker_files/marker_sequence.h"

namespace depthmocap {

// What `repair` is measured against: gaps filled from the correlation of markers with each other within the sequence
// itself (after Gloersen and Federolf 2016). Coordinates about the mean of those markers that are always seen;
// principal components of the frames that show every marker; a gap takes what the components of the frame's other
// markers say, moved so that it meets the samples before and after it. With gaps in every frame or every marker: by
// splines alone.
void fillByPca(MarkerSequence& markers);

// Noise removed by the same components: each frame's projection on those that hold 99 % of the variance. Nothing may
// be missing.
void projectOnPca(MarkerSequence& markers);

// The zero-phase Butterworth low-pass of second order (applied forwards and backwards) of biomechanics. Nothing may be
// missing, frames are evenly spaced.
void lowPass(MarkerSequence& markers, double cutoff_hz);

}  // namespace depthmocap
