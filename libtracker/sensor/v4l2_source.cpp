#include "libtracker/sensor/v4l2_source.h"

#include <utility>

#include "libtracker/recording/undistort.h"
#include "libtracker/recording/usual_camera.h"
#include "libtracker/sensor/camera_calibration.h"
#include "libtracker/sensor/frame_stamps.h"
#include "libtracker/sensor/v4l2_stream.h"

namespace depthmocap {

namespace {

constexpr std::uint32_t kBackwards = 1U << 31U;  // a larger step of a count of 32 bits is one back

double unitOf(const SourceOptions& options, std::uint32_t fourcc) {
  if (options.depth_unit_m) return *options.depth_unit_m;
  return options.camera ? options.camera->depth_unit_m : defaultDepthUnit_m(fourcc);
}

class V4l2Source : public DepthSource {
 public:
  V4l2Source(const std::string& path, const SourceOptions& options, V4l2System& system)
      : stream_(system, path, options), raw_values_(options.depth_unit_m.has_value()) {
    info_.camera = usualCamera(stream_.format().width, stream_.format().height);
    if (!options.camera) info_.guesses.push_back(path + ": does not tell its intrinsics: " + guessText(info_.camera));
    undistortion_ = calibrate(options.camera, info_);
    info_.fps = stream_.fps();
    info_.depth_unit_m = unitOf(options, stream_.format().fourcc);
    info_.camera_name = stream_.name();
    info_.note = "recorded through V4L2, " + fourccName(stream_.format().fourcc);
  }
  [[nodiscard]] const RecordingInfo& info() const override { return info_; }
  [[nodiscard]] std::string problem() const override { return stream_.problem(); }
  SourceState next(SensorFrame& frame, std::chrono::milliseconds timeout) override;

 private:
  V4l2Stream stream_;
  bool raw_values_;  // the user's unit is of the camera's own numbers
  RecordingInfo info_;
  std::vector<std::int32_t> undistortion_;  // empty: none
  Image<std::uint16_t> steps_;
  FrameStamps stamps_;
  std::uint32_t last_sequence_ = 0;
  std::int64_t count_ = 0;  // the driver's, which may run over, made to grow
};

SourceState V4l2Source::next(SensorFrame& frame, std::chrono::milliseconds timeout) {
  V4l2Picture picture;
  const SourceState state = stream_.next(picture, timeout);
  if (state != SourceState::Frame) return state;
  const std::uint32_t step = picture.sequence - std::exchange(last_sequence_, picture.sequence);
  count_ += step < kBackwards ? step : 0;
  // SensorClock is the kernel's monotonic clock.
  stamps_.stamp({count_, picture.time_s, picture.monotonic}, info_.fps, frame);
  unpack(stream_.format(), picture.bytes, raw_values_, steps_);
  toMetres(steps_, info_.depth_unit_m, undistortion_, frame.depth.depth);
  return SourceState::Frame;
}

}  // namespace

std::unique_ptr<DepthSource> openV4l2Camera(const std::string& path, const SourceOptions& options, V4l2System& system) {
  return std::make_unique<V4l2Source>(path, options, system);
}

}  // namespace depthmocap
