#include "libtracker/sensor/openni_source.h"

#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "depthmocap/error.h"
#include "libtracker/openni/openni_stream.h"
#include "libtracker/recording/undistort.h"
#include "libtracker/sensor/camera_calibration.h"
#include "libtracker/sensor/camera_driver.h"
#include "libtracker/sensor/frame_stamps.h"
#include "libtracker/sensor/returning_source.h"

namespace depthmocap {

namespace {

constexpr const char* kNoCameraAdvice =
    "check that it is plugged in and has power, that its udev rules let you read it, that the kernel's gspca_kinect "
    "does not hold it, and that a driver for it lies in OpenNI2/Drivers; docs/guide/cameras.md has more";

std::string_view withoutPort(std::string_view uri) {
  return uri.substr(0, uri.find('@'));
}

std::string list(const std::vector<OpenNiDevice>& devices) {
  std::string text;
  for (const OpenNiDevice& device : devices) {
    text += fmt::format("{}{} ({} {})", text.empty() ? "" : ", ", device.uri, device.vendor, device.name);
  }
  return text;
}

// A URI that the runtime does not list is tried as it is: some drivers open what they do not find by themselves.
std::string findUri(const OpenNiRuntime& runtime, const std::string& wanted) {
  const std::vector<OpenNiDevice> devices = openNiDevices(runtime);
  if (wanted.empty()) {
    if (devices.empty()) throw Error("no camera found", "openni2", kNoCameraAdvice);
    return devices.front().uri;
  }
  for (const OpenNiDevice& device : devices) {
    if (device.uri == wanted) return wanted;
  }
  for (const OpenNiDevice& device : devices) {
    if (withoutPort(device.uri) == withoutPort(wanted)) return device.uri;
  }
  return wanted;
}

std::unique_ptr<OpenNiStream> openStream(const std::string& wanted, const SourceOptions& options) {
  std::shared_ptr<OpenNiRuntime> runtime = OpenNiRuntime::start();
  const std::string uri = findUri(*runtime, wanted);
  std::optional<OpenNiMode> mode;
  if (options.mode)
    mode = {options.mode->width, options.mode->height, static_cast<int>(std::lround(options.mode->fps))};
  try {
    return std::make_unique<OpenNiStream>(runtime, uri, mode);
  } catch (const Error& error) {
    const std::string found = list(openNiDevices(*runtime));
    throw Error(error.what(), "openni2", found.empty() ? kNoCameraAdvice : "cameras found: " + found);
  }
}

class OpenNiSource : public DepthSource {
 public:
  OpenNiSource(std::unique_ptr<OpenNiStream> stream, const SourceOptions& options)
      : stream_(std::move(stream)), unit_m_(options.depth_unit_m.value_or(stream_->depthUnit_m())) {
    info_.camera = stream_->camera();
    info_.fps = stream_->fps();
    info_.depth_unit_m = unit_m_;
    info_.camera_name = stream_->name();
    info_.note = "recorded through OpenNI2";
    undistortion_ = calibrate(options.camera, info_);
  }
  [[nodiscard]] const RecordingInfo& info() const override { return info_; }
  [[nodiscard]] std::string problem() const override { return problem_; }
  SourceState next(SensorFrame& frame, std::chrono::milliseconds timeout) override;

 private:
  std::unique_ptr<OpenNiStream> stream_;
  double unit_m_;
  RecordingInfo info_;
  std::vector<std::int32_t> undistortion_;  // empty: none
  OpenNiFrame raw_;
  FrameStamps stamps_;
  std::string problem_;
};

SourceState OpenNiSource::next(SensorFrame& frame, std::chrono::milliseconds timeout) {
  if (stream_->lost()) {
    problem_ = "the camera was unplugged";
    return SourceState::Lost;
  }
  try {
    if (!stream_->read(raw_, timeout)) return SourceState::Waiting;
  } catch (const Error& error) {
    problem_ = error.what();
    return SourceState::Damaged;
  }
  stamps_.stamp({raw_.index, raw_.time_s, false}, info_.fps, frame);
  toMetres(raw_.steps, unit_m_, undistortion_, frame.depth.depth);
  return SourceState::Frame;
}

std::string checkAddress(std::optional<std::string_view> address) {
  return address == "" ? "openni2: needs a URI, or no colon" : "";
}

// Holds the runtime while the camera is away: the runtime hears when it comes back.
std::unique_ptr<DepthSource> openReturning(const std::string& uri, const SourceOptions& options) {
  return std::make_unique<ReturningSource>(
      [uri, options, runtime = OpenNiRuntime::start()] { return openOpenNiCamera(uri, options); });
}

// None where the runtime cannot start: no driver, no camera.
std::vector<FoundCamera> listCameras() {
  std::vector<FoundCamera> found;
  try {
    for (const OpenNiDevice& device : openNiDevices(*OpenNiRuntime::start())) {
      found.push_back({"openni2:" + device.uri, device.vendor + " " + device.name, ""});
    }
  } catch (const Error&) {
    return {};
  }
  return found;
}

}  // namespace

std::unique_ptr<DepthSource> openOpenNiCamera(const std::string& uri, const SourceOptions& options) {
  return std::make_unique<OpenNiSource>(openStream(uri, options), options);
}

CameraDriver openNiDriver() {
  return {.prefix = "openni2",
          .title = "OpenNI2",
          .names = {"openni2", "openni2:URI"},
          .remark = "",
          .options = {},
          .check = checkAddress,
          .open = openReturning,
          .list = listCameras};
}

}  // namespace depthmocap
