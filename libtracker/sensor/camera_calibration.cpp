#include "libtracker/sensor/camera_calibration.h"

#include <fmt/format.h>

#include "depthmocap/error.h"
#include "libtracker/recording/undistort.h"

namespace depthmocap {

std::vector<std::int32_t> calibrate(const std::optional<RecordingInfo>& calibration, RecordingInfo& info) {
  if (calibration) {
    const CameraModel& given = calibration->camera;
    if (given.width != info.camera.width || given.height != info.camera.height) {
      throw Error(fmt::format("describes pictures of {}x{}, the camera's are {}x{}", given.width, given.height,
                              info.camera.width, info.camera.height),
                  "--camera");
    }
    info.camera = given;
  }
  std::vector<std::int32_t> map;
  if (info.camera.hasDistortion()) map = undistortionMap(info.camera);
  info.camera.distortion = {};
  return map;
}

}  // namespace depthmocap
