#pragma once
#include <memory>

#include "libtracker/recording/recording.h"

namespace depthmocap {

// The camera of pictures turned clockwise by `turn_deg` (0, 90, 180 or 270): size, intrinsics and distortion.
CameraModel turnedCamera(const CameraModel& camera, int turn_deg);

// `in` turned clockwise by `turn_deg` (0, 90, 180 or 270) to `out`, another image, whose memory is reused.
void turnDepth(const DepthImage& in, int turn_deg, DepthImage& out);

// A recording as if its camera had hung upright: pictures and camera turned clockwise by `turn_deg` (0, 90, 180 or
// 270). 0: the recording itself.
std::unique_ptr<RecordingReader> turnedRecording(std::unique_ptr<RecordingReader> recording, int turn_deg);

}  // namespace depthmocap
