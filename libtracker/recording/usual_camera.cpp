#include "libtracker/recording/usual_camera.h"

#include <fmt/format.h>

namespace depthmocap {

namespace {

// Focal length over width of pictures of 16:9: the infrared imagers of RealSense D435 and D455, 90 degrees wide (Intel,
// D400 series datasheet). Those of the D415 and pictures aligned to a colour camera have about 0.7.
constexpr double kWideFocal = 0.5;
constexpr double kWideAspect = 1.7;  // width over height from which on pictures are taken for 16:9

}  // namespace

// One copy of a Kinect of 2013 differs from the next by a pixel or two.
CameraModel usualCamera(int width, int height) {
  CameraModel camera;
  camera.width = width;
  camera.height = height;
  if (width == 512 && height == 424) {
    camera.fx = camera.fy = 365.456;
    camera.cx = 254.878;
    camera.cy = 205.395;
    camera.distortion = {0.0905474, -0.26819, 0, 0, 0.0950862};
    return camera;
  }
  camera.fx = camera.fy = (width > kWideAspect * height ? kWideFocal : kPrimeSenseFocal) * width;
  camera.cx = (width - 1) / 2.0;
  camera.cy = (height - 1) / 2.0;
  return camera;
}

// A focal length that is 1.4 times too long makes people 1.4 times too small.
std::string guessText(const CameraModel& usual) {
  return fmt::format(
      "those usual for {}x{} pictures are taken, focal length {:.0f} px, and sizes are as wrong as that is; --camera "
      "C.json gives its own (docs/guide/cameras.md)",
      usual.width, usual.height, usual.fx);
}

}  // namespace depthmocap
