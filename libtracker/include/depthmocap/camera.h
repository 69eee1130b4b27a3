#pragma once
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "depthmocap/camera_correction.h"
#include "depthmocap/camera_model.h"
#include "depthmocap/depth_frame.h"
#include "depthmocap/export.h"

namespace depthmocap {

class DepthSource;

// What a source has after waiting for it.
enum class SourceState {
  Frame,    // a frame
  Waiting,  // none yet
  Damaged,  // a frame came that cannot be used; problem() says why
  Lost,     // the camera is gone; problem() says why. A source that cannot come back stays lost
  Ended,    // a recording is over
};

// A picture size and rate that a camera is asked for.
struct DepthMode {
  int width = 0;   // [px]
  int height = 0;  // [px]
  double fps = 0;  // [1/s]; 0 = any
};

// A camera that is plugged in.
struct FoundCamera {
  std::string source;   // its name for Camera
  std::string name;     // of maker and model
  std::string formats;  // V4L2: the pixel formats that hold depth
};

// What may be asked of a camera beyond its name.
struct CameraOptions {
  std::optional<DepthMode> mode{};  // none: 640x480 at 30 per second, or the nearest that the camera has
  std::string pixel_format{};       // V4L2 fourcc; empty: the best one that the camera offers
  double speed = 1;                 // (>= 0) of a replay; 0 = as fast as frames are asked for
  CameraCorrection correction{};    // what you know better than the camera
};

// A live depth camera, or a recording that behaves as one. One thread at a time. A camera comes back after it was
// unplugged.
class DEPTHMOCAP_API Camera {
 public:
  // Sources: `openni2`, `openni2:URI` (where the library has the component openni2), `v4l2:/dev/videoN`, `replay:REC`,
  // `pipe:PATH` (docs/reference/pipe.md). Throws Error for another name, a camera that is not there or cannot be used,
  // a recording that cannot be read.
  explicit Camera(const std::string& source, const CameraOptions& options = {});
  ~Camera();
  Camera(Camera&& other) noexcept;
  Camera& operator=(Camera&& other) noexcept;

  // The cameras that are plugged in now, of all drivers that the library has.
  static std::vector<FoundCamera> list();

  // The camera of the frames, whose distortion has been taken out. Constant.
  [[nodiscard]] const CameraModel& model() const;
  // Nominal frame rate [1/s] (> 0).
  [[nodiscard]] double fps() const;
  // The camera's name, "kinect1" for example; may be empty.
  [[nodiscard]] const std::string& name() const;

  // Waits at most `timeout` for the next frame: depth [m], undistorted, 0 = no measurement, of the model's size; number
  // and time [s] are the sensor's, from 0, and grow also over an unplugged cable. `frame`, whose memory is reused, is
  // changed with SourceState::Frame only. Trouble with the camera is a state, no exception.
  SourceState next(DepthFrame& frame, std::chrono::milliseconds timeout);
  // Why the source is damaged or lost, for people; else empty.
  [[nodiscard]] std::string problem() const;

 private:
  friend class Session;
  std::unique_ptr<DepthSource> source_;
};

}  // namespace depthmocap
