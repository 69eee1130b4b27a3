#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "libtracker/recording/recording.h"

namespace depthmocap {

// Puts the camera of `calibration` (none: the one of `info` stays) into `info`, without its distortion, and returns the
// map that takes the distortion out of its pictures (recording/undistort.h; empty: it has none). Error if it is of
// pictures of another size.
std::vector<std::int32_t> calibrate(const std::optional<RecordingInfo>& calibration, RecordingInfo& info);

}  // namespace depthmocap
