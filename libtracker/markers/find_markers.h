#pragma once
#include <array>

#include "libtracker/classify/classified_pixels.h"
#include "libtracker/core/camera.h"
#include "libtracker/core/marker_set.h"

namespace depthmocap {

struct MarkerConfig {
  double bandwidth_m = 0.07;          // [m] of the MeanShift kernel
  double min_probability = 0.15;      // a pixel votes for a part from this probability on
  double min_area_m2 = 0.002;         // [m^2] seen surface below which a part gives no marker
  int max_iterations = 20;            // of MeanShift
  bool push_in = true;                // beyond the paper: move the mode into the body along the viewing ray
  void validate() const;
};

}  // namespace depthmocap
