#pragma once
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "depthmocap/camera_model.h"
#include "depthmocap/image.h"
#include "libtracker/openni/openni_runtime.h"

namespace depthmocap {

// Size and rate of depth pictures.
struct OpenNiMode {
  int width = 0;   // [px]
  int height = 0;  // [px]
  int fps = 0;     // [1/s]; 0 = any
};

// A depth picture as the runtime gives it, but never mirrored.
struct OpenNiFrame {
  Image<std::uint16_t> steps;  // of depthUnit_m(); 0 = no measurement
  std::int64_t index = 0;      // the device's count
  double time_s = 0;           // [s] the device's clock
};

// The depth stream of a camera, opened through the OpenNI2 runtime. Not thread-safe.
class OpenNiStream {
 public:
  // A camera by its URI. `mode`: none = 640x480 at 30 per second, or what comes nearest. Error if it cannot be opened,
  // gives no depth, or has no such mode.
  OpenNiStream(std::shared_ptr<OpenNiRuntime> runtime, const std::string& uri, const std::optional<OpenNiMode>& mode);
  ~OpenNiStream();

  [[nodiscard]] const CameraModel& camera() const;  // from the field of view; no distortion
  [[nodiscard]] double fps() const;                 // [1/s] that the mode promises
  [[nodiscard]] double depthUnit_m() const;
  [[nodiscard]] const std::string& name() const;  // of the device
  // True once the camera was unplugged or has failed; it stays so.
  [[nodiscard]] bool lost() const;

  // The next frame; false if none came in time. Error for one that cannot be used.
  bool read(OpenNiFrame& frame, std::chrono::milliseconds timeout);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace depthmocap
