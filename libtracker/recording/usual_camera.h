#pragma once
#include <string>

#include "depthmocap/camera_model.h"

namespace depthmocap {

// Focal length over width of PrimeSense cameras: the Kinect of 2010 and its relatives.
inline constexpr double kPrimeSenseFocal = 575.8 / 640;

// What is known of a depth camera by the size of its pictures [px] (> 0) alone: a guess, up to 1.8 times off for wide
// pictures.
CameraModel usualCamera(int width, int height);

// What was taken and what to do, for RecordingInfo::guesses.
std::string guessText(const CameraModel& usual);

}  // namespace depthmocap
