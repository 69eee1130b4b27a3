#pragma once
#include "libtracker/marker_files/marker_sequence.h"

namespace depthmocap {

// Fills what was not seen of a track: straight lines, or the natural cubic spline, between the samples before and
// after. Before the first and after the last sample the place stays. A track that was never seen stays as it is.
void fillLinearly(const std::vector<double>& time_s, MarkerTrack& track);
void fillBySpline(const std::vector<double>& time_s, MarkerTrack& track);

}  // namespace depthmocap
