#include "libtracker/core/check_camera.h"

#include <cmath>
#include <cstdint>

#include <fmt/format.h>

#include "depthmocap/error.h"

namespace depthmocap {

namespace {

constexpr int kLargestSide = 16384;  // [px]
// [px] keeps a damaged header from asking for all memory; 3840 x 2160 is more than any depth camera has.
constexpr std::int64_t kLargestArea = 3840 * 2160;
// [px] of focal lengths and centre: six times the largest side, a lens of 9 degrees.
constexpr double kLargestPixel = 1e5;
constexpr double kSmallestFocal = 0.1;  // [px] of the widest lens on the smallest picture

}  // namespace

void requireRange(const char* field, double value, double low, double high, const std::string& where) {
  if (value >= low && value <= high) return;
  throw Error(fmt::format("\"{}\" must lie in [{:g}, {:g}], not {:g}", field, low, high, value), where);
}

void checkCamera(const CameraModel& camera, const std::string& where) {
  for (const int side : {camera.width, camera.height}) {
    if (side < 1 || side > kLargestSide) {
      throw Error(fmt::format("width and height must lie in [1, {}]", kLargestSide), where);
    }
  }
  if (std::int64_t{camera.width} * camera.height > kLargestArea) {
    throw Error(
        fmt::format("the pictures must have at most {} pixels, not {} x {}", kLargestArea, camera.width, camera.height),
        where);
  }
  requireRange("fx", camera.fx, kSmallestFocal, kLargestPixel, where);
  requireRange("fy", camera.fy, kSmallestFocal, kLargestPixel, where);
  requireRange("cx", camera.cx, -kLargestPixel, kLargestPixel, where);
  requireRange("cy", camera.cy, -kLargestPixel, kLargestPixel, where);
  for (const double k : camera.distortion) {
    if (!std::isfinite(k)) throw Error("\"distortion\" must be finite", where);
  }
}

void checkFrame(const DepthFrame& frame, const CameraModel& camera) {
  const std::string where = fmt::format("frame {}", frame.frame);
  const DepthImage& depth = frame.depth;
  if (depth.width != camera.width || depth.height != camera.height) {
    throw Error(fmt::format("the image is {}x{}, the camera's are {}x{}", depth.width, depth.height, camera.width,
                            camera.height),
                where, "take the model of the camera that the frame is of");
  }
  if (depth.data.size() != depth.index(0, depth.height)) {
    throw Error(fmt::format("the image of {}x{} has {} values", depth.width, depth.height, depth.data.size()), where);
  }
  if (!std::isfinite(frame.time_s)) throw Error(fmt::format("its time is {}, no number", frame.time_s), where);
}

}  // namespace depthmocap
