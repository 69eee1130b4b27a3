#pragma once
#include <cstdint>
#include <string>

#include "libtracker/session/durations.h"

namespace depthmocap {

// What only a live run has to tell (stats file: "live").
struct LiveFigures {
  std::string source;
  std::int64_t received = 0;      // frames that came from the camera
  std::int64_t replaced = 0;      // of them, dropped because a newer one was there
  std::int64_t missing = 0;       // taken by the camera, but lost on the way here
  std::int64_t damaged = 0;       // came, but could not be used
  std::int64_t returns = 0;       // times the camera was lost and found again
  std::int64_t recorded = 0;      // --record: frames written
  std::int64_t not_recorded = 0;  // --record: frames that the disk was too slow for
  // From the sensor's time stamp until all outputs had the frame; one value per frame.
  Durations latency{Durations::Keep::Binned};
};

}  // namespace depthmocap
