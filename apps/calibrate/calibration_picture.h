#pragma once
#include <filesystem>

#include "calibration/calibrator.h"
#include "depthmocap/camera_model.h"

namespace depthmocap {

// A PNG of what a calibration found: the actor's depth points, the cylinders fitted to arms, legs and torso, and the
// skeleton, seen from the camera and from the side. Written whole or not at all.
void writeCalibrationPicture(const std::filesystem::path& path, const Calibrator::Shown& shown, const Actor& actor,
                             const CameraModel& camera);

}  // namespace depthmocap
