#include "libtracker/openni/openni_stream.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <tuple>
#include <utility>

#include <OpenNI.h>
#include <fmt/format.h>

#include "depthmocap/error.h"

namespace depthmocap {

namespace {

using openni::STATUS_OK;
using openni::VideoMode;

constexpr double kDefaultFocalLength = 575.8 / 640;  // of the width, as PrimeSense cameras have it

// [m] a step; 0 for formats that are no depth without the device's tables.
double unitOf(openni::PixelFormat format) {
  if (format == openni::PIXEL_FORMAT_DEPTH_1_MM) return 0.001;
  return format == openni::PIXEL_FORMAT_DEPTH_100_UM ? 0.0001 : 0;
}

std::string describe(const VideoMode& mode) {
  return fmt::format("{}x{}@{}", mode.getResolutionX(), mode.getResolutionY(), mode.getFps());
}

bool fits(const VideoMode& mode, const OpenNiMode& wanted) {
  return mode.getResolutionX() == wanted.width && mode.getResolutionY() == wanted.height &&
         (wanted.fps == 0 || mode.getFps() == wanted.fps);
}

// How far a mode is from what we like best: smaller is better.
auto distance(const VideoMode& mode, const OpenNiMode& wanted) {
  const int wanted_fps = wanted.fps > 0 ? wanted.fps : 30;
  return std::tuple(std::abs(mode.getResolutionX() * mode.getResolutionY() - wanted.width * wanted.height),
                    std::abs(mode.getFps() - wanted_fps), mode.getPixelFormat() != openni::PIXEL_FORMAT_DEPTH_1_MM);
}

VideoMode chooseMode(const openni::Array<VideoMode>& modes, const std::optional<OpenNiMode>& wanted,
                     const std::string& where) {
  const OpenNiMode target = wanted.value_or(OpenNiMode{640, 480, 30});
  const VideoMode* best = nullptr;
  std::string offered;
  for (int i = 0; i < modes.getSize(); ++i) {
    if (unitOf(modes[i].getPixelFormat()) == 0) continue;
    const std::string text = describe(modes[i]);
    if (offered.find(text) == std::string::npos) offered += (offered.empty() ? "" : ", ") + text;
    if (wanted && !fits(modes[i], target)) continue;
    if (best == nullptr || distance(modes[i], target) < distance(*best, target)) best = &modes[i];
  }
  if (offered.empty()) throw Error("gives no depth in millimetres", where);
  if (best == nullptr) {
    throw Error(fmt::format("has no mode {}x{}{}", target.width, target.height,
                            target.fps > 0 ? fmt::format("@{}", target.fps) : ""),
                where, "it has " + offered);
  }
  return *best;
}

double focalLength(int pixels, int width, float field_of_view) {
  const double f = pixels / (2.0 * std::tan(field_of_view / 2.0));
  return std::isfinite(f) && f > 0.1 * pixels && f < 10.0 * pixels ? f : kDefaultFocalLength * width;
}

}  // namespace

// Hears of the cable on threads of the driver.
struct OpenNiStream::Impl : openni::OpenNI::DeviceDisconnectedListener, openni::OpenNI::DeviceStateChangedListener {
  Impl(std::shared_ptr<OpenNiRuntime> running, std::string uri_or_path)
      : runtime(std::move(running)), where(std::move(uri_or_path)) {
    openni::OpenNI::addDeviceDisconnectedListener(this);
    openni::OpenNI::addDeviceStateChangedListener(this);
  }
  ~Impl() override {
    openni::OpenNI::removeDeviceDisconnectedListener(this);
    openni::OpenNI::removeDeviceStateChangedListener(this);
    if (stream.isValid()) stream.stop();
    stream.destroy();
    device.close();
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  void onDeviceDisconnected(const openni::DeviceInfo* info) override {
    if (where == info->getUri()) lost = true;
  }
  void onDeviceStateChanged(const openni::DeviceInfo* info, openni::DeviceState state) override {
    if (where == info->getUri() && state != openni::DEVICE_STATE_OK) lost = true;
  }

  void require(openni::Status status, const std::string& what) const {
    if (status != STATUS_OK) throw Error(what + ": " + openNiError(), where);
  }
  void open();
  void describeCamera();
  void start();
  void copy(const openni::VideoFrameRef& source, OpenNiFrame& frame) const;

  std::shared_ptr<OpenNiRuntime> runtime;
  std::string where;
  openni::Device device;
  openni::VideoStream stream;
  CameraModel camera;
  double fps = 30;
  double unit_m = 0.001;
  std::string name;
  bool mirrored = false;  // the device insists; undone here
  std::atomic<bool> lost{false};
};

void OpenNiStream::Impl::open() {
  require(device.open(where.c_str()), "cannot be opened");
  name = device.getDeviceInfo().getName();
  if (device.getSensorInfo(openni::SENSOR_DEPTH) == nullptr) throw Error("gives no depth", where);
  require(stream.create(device, openni::SENSOR_DEPTH), "its depth stream cannot be opened");
}

void OpenNiStream::Impl::describeCamera() {
  const VideoMode mode = stream.getVideoMode();
  unit_m = unitOf(mode.getPixelFormat());
  if (unit_m == 0) throw Error("gives no depth in millimetres", where);
  fps = mode.getFps() > 0 ? mode.getFps() : 30;
  camera.width = mode.getResolutionX();
  camera.height = mode.getResolutionY();
  camera.fx = focalLength(camera.width, camera.width, stream.getHorizontalFieldOfView());
  camera.fy = focalLength(camera.height, camera.width, stream.getVerticalFieldOfView());
  camera.cx = (camera.width - 1) / 2.0;
  camera.cy = (camera.height - 1) / 2.0;
}

void OpenNiStream::Impl::start() {
  // Left and right matter: pictures come as the camera sees them, or are turned round again in copy().
  stream.setMirroringEnabled(false);
  mirrored = stream.getMirroringEnabled();
  if (stream.isCroppingSupported()) stream.resetCropping();
  if (device.isImageRegistrationModeSupported(openni::IMAGE_REGISTRATION_OFF)) {
    device.setImageRegistrationMode(openni::IMAGE_REGISTRATION_OFF);
  }
  require(stream.start(), "its depth stream cannot be started");
}

void OpenNiStream::Impl::copy(const openni::VideoFrameRef& source, OpenNiFrame& frame) const {
  const int width = source.getWidth();
  const int height = source.getHeight();
  const int stride = source.getStrideInBytes();
  const int left = source.getCroppingEnabled() ? source.getCropOriginX() : 0;
  const int top = source.getCroppingEnabled() ? source.getCropOriginY() : 0;
  const bool inside = left >= 0 && top >= 0 && left + width <= camera.width && top + height <= camera.height;
  if (!inside || width < 1 || height < 1 || stride < 2 * width ||
      source.getDataSize() < stride * (height - 1) + 2 * width ||
      unitOf(source.getVideoMode().getPixelFormat()) != unit_m) {
    throw Error(fmt::format("frame {} does not fit the mode of the stream", source.getFrameIndex()), where);
  }
  frame.steps.reset(camera.width, camera.height, 0);
  for (int y = 0; y < height; ++y) {
    std::uint16_t* row = &frame.steps.at(left, top + y);
    std::memcpy(row, static_cast<const char*>(source.getData()) + static_cast<std::ptrdiff_t>(y) * stride,
                2 * static_cast<std::size_t>(width));
    std::uint16_t* whole = &frame.steps.at(0, top + y);
    if (mirrored) std::reverse(whole, whole + camera.width);
  }
  frame.index = source.getFrameIndex();
  frame.time_s = static_cast<double>(source.getTimestamp()) * 1e-6;
}

OpenNiStream::OpenNiStream(std::shared_ptr<OpenNiRuntime> runtime, const std::string& uri,
                           const std::optional<OpenNiMode>& mode)
    : impl_(std::make_unique<Impl>(std::move(runtime), uri)) {
  impl_->open();
  const openni::SensorInfo& sensor = impl_->stream.getSensorInfo();
  const VideoMode chosen = chooseMode(sensor.getSupportedVideoModes(), mode, uri);
  impl_->require(impl_->stream.setVideoMode(chosen), "refuses the mode " + describe(chosen));
  impl_->describeCamera();
  impl_->start();
}

OpenNiStream::~OpenNiStream() = default;

const CameraModel& OpenNiStream::camera() const {
  return impl_->camera;
}
double OpenNiStream::fps() const {
  return impl_->fps;
}
double OpenNiStream::depthUnit_m() const {
  return impl_->unit_m;
}
const std::string& OpenNiStream::name() const {
  return impl_->name;
}
bool OpenNiStream::lost() const {
  return impl_->lost;
}

bool OpenNiStream::read(OpenNiFrame& frame, std::chrono::milliseconds timeout) {
  openni::VideoStream* streams[] = {&impl_->stream};
  int ready = -1;
  if (openni::OpenNI::waitForAnyStream(streams, 1, &ready, static_cast<int>(timeout.count())) != STATUS_OK) {
    return false;
  }
  openni::VideoFrameRef source;
  if (impl_->stream.readFrame(&source) != STATUS_OK || !source.isValid()) return false;
  impl_->copy(source, frame);
  return true;
}

}  // namespace depthmocap
