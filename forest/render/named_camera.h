#pragma once
#include <optional>
#include <span>
#include <string_view>

#include "depthmocap/camera_model.h"

namespace depthmocap {

// Cameras that can be rendered, by what they deliver. How each measures: sensor_model.h.
enum class SensorKind {
  Kinect1,
  Kinect2,
  D435,          // RealSense D435, filtered, holes filled, aligned to the colour image
  D435Raw,       // as the camera delivers it
  D435Hd,        // likewise, 1280x720
  D435Portrait,  // D435 on its side, the image upright again
  Orbbec,        // Orbbec Gemini 2: smoothed in the camera, large holes stay
  Azure,         // Azure Kinect, narrow field of view, unbinned
};

struct NamedCamera {
  SensorKind kind;
  std::string_view name;
  int width, height;  // [px]
  double focal_px;    // [px] nominal
  double reach_m;     // [m] the whole of a body is measured up to here
};

// In the order of SensorKind.
std::span<const NamedCamera> namedCameras();
const NamedCamera& namedCamera(SensorKind kind);

std::string_view sensorName(SensorKind kind);
std::optional<SensorKind> sensorNamed(std::string_view name);

// Nominal intrinsics. half_size: every second pixel, as the 320x240 mode of Kinect v1.
CameraModel sensorCamera(SensorKind kind, bool half_size = false);

}  // namespace depthmocap
