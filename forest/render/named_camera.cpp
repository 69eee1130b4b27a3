#include "forest/render/named_camera.h"

#include <array>
#include <cstddef>

namespace depthmocap {
namespace {

// Kinect v1: Khoshelham and Elberink 2012. D435: 617 px where depth is aligned to the colour image of 640x480, 385 and
// 640 px of its infrared imagers (90 degrees wide at 1280x720; Intel, D400 series datasheet). Gemini 2: 91 degrees wide
// at 640x400 (Orbbec's data sheet). Azure: 75 degrees wide (Microsoft's hardware specification says 75x65 degrees,
// within the 640x576 image by f = 504 px). Reaches: StagingConfig's for the far-sighted, otherwise some 20 cm less than
// the specified range.
constexpr std::array<NamedCamera, 8> kCameras = {{
    {SensorKind::Kinect1, "kinect1", 640, 480, 575.8, 5.6},
    {SensorKind::Kinect2, "kinect2", 512, 424, 365.0, 4.3},
    {SensorKind::D435, "d435", 640, 480, 617.0, 5.6},
    {SensorKind::D435Raw, "d435_raw", 640, 480, 385.0, 5.6},
    {SensorKind::D435Hd, "d435_hd", 1280, 720, 640.0, 5.6},
    {SensorKind::D435Portrait, "d435_portrait", 480, 640, 617.0, 5.6},
    {SensorKind::Orbbec, "orbbec", 640, 400, 314.0, 5.6},
    {SensorKind::Azure, "azure", 640, 576, 504.0, 3.6},
}};

}  // namespace

std::span<const NamedCamera> namedCameras() {
  return kCameras;
}

const NamedCamera& namedCamera(SensorKind kind) {
  return kCameras[static_cast<std::size_t>(kind)];
}

std::string_view sensorName(SensorKind kind) {
  return namedCamera(kind).name;
}

std::optional<SensorKind> sensorNamed(std::string_view name) {
  for (const NamedCamera& camera : kCameras) {
    if (camera.name == name) return camera.kind;
  }
  return std::nullopt;
}

CameraModel sensorCamera(SensorKind kind, bool half_size) {
  const NamedCamera& named = namedCamera(kind);
  CameraModel camera;
  camera.width = named.width;
  camera.height = named.height;
  camera.fx = camera.fy = named.focal_px;
  if (half_size) {
    camera.width /= 2;
    camera.height /= 2;
    camera.fx = camera.fy = camera.fx / 2;
  }
  camera.cx = 0.5 * (camera.width - 1);
  camera.cy = 0.5 * (camera.height - 1);
  return camera;
}

}  // namespace depthmocap
