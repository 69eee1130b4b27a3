// A driver for the OpenNI2 runtime that serves a recording as a camera, with faults on demand.
//
// DEPTHMOCAP_TEST_RECORDING names the recording; without it there is no device. It is served in a loop, at its own
// pace. DEPTHMOCAP_TEST_FAULTS says what goes wrong (served_recording.h).
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "Driver/OniDriverAPI.h"
#include "tests/drivers/served_recording.h"

namespace depthmocap::testdriver {

namespace {

using Clock = std::chrono::steady_clock;

std::string fromEnvironment(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

// What the device holds and how far it has come; outlives streams, as a camera outlives those who open it.
struct Device {
  ServedRecording recording;
  Faults faults = parseFaults(fromEnvironment("DEPTHMOCAP_TEST_FAULTS"));
  std::atomic<bool> plugged{true};
  std::atomic<bool> stalled_once{false};
  std::atomic<bool> asks_unplug{false};
};

template <typename T>
OniStatus give(const T& value, void* data, int* size) {
  if (*size != static_cast<int>(sizeof(T))) return ONI_STATUS_BAD_PARAMETER;
  std::memcpy(data, &value, sizeof(T));
  return ONI_STATUS_OK;
}

class Stream : public oni::driver::StreamBase {
 public:
  explicit Stream(Device& device) : device_(device) { mode_ = modes()[0]; }
  ~Stream() override { halt(); }

  // The first is one that needs a table to understand, as real cameras have.
  std::array<OniVideoMode, 4> modes() const {
    const int w = device_.recording.width;
    const int h = device_.recording.height;
    return {OniVideoMode{ONI_PIXEL_FORMAT_SHIFT_9_2, w, h, 30},
            OniVideoMode{ONI_PIXEL_FORMAT_DEPTH_1_MM, w / 2, h / 2, 30},
            OniVideoMode{ONI_PIXEL_FORMAT_DEPTH_100_UM, w, h, 30}, OniVideoMode{ONI_PIXEL_FORMAT_DEPTH_1_MM, w, h, 30}};
  }

  OniBool isPropertySupported(int id) override {
    return id == ONI_STREAM_PROPERTY_VIDEO_MODE || id == ONI_STREAM_PROPERTY_HORIZONTAL_FOV ||
           id == ONI_STREAM_PROPERTY_VERTICAL_FOV || id == ONI_STREAM_PROPERTY_MIRRORING ||
           id == ONI_STREAM_PROPERTY_MAX_VALUE;
  }
  OniStatus getProperty(int id, void* data, int* size) override {
    const ServedRecording& r = device_.recording;
    if (id == ONI_STREAM_PROPERTY_VIDEO_MODE) return give(mode_, data, size);
    if (id == ONI_STREAM_PROPERTY_HORIZONTAL_FOV) {
      return give(static_cast<float>(2 * std::atan(r.width / (2 * r.fx))), data, size);
    }
    if (id == ONI_STREAM_PROPERTY_VERTICAL_FOV) {
      return give(static_cast<float>(2 * std::atan(r.height / (2 * r.fy))), data, size);
    }
    if (id == ONI_STREAM_PROPERTY_MIRRORING) return give<OniBool>(mirrored_ ? TRUE : FALSE, data, size);
    if (id == ONI_STREAM_PROPERTY_MAX_VALUE) return give<int>(10000, data, size);
    return ONI_STATUS_NOT_SUPPORTED;
  }
  OniStatus setProperty(int id, const void* data, int) override {
    if (id == ONI_STREAM_PROPERTY_VIDEO_MODE) mode_ = *static_cast<const OniVideoMode*>(data);
    if (id == ONI_STREAM_PROPERTY_MIRRORING && !device_.faults.stuck_mirror) {
      mirrored_ = *static_cast<const OniBool*>(data) != FALSE;
    }
    return isPropertySupported(id) ? ONI_STATUS_OK : ONI_STATUS_NOT_SUPPORTED;
  }

  OniStatus start() override {
    running_ = true;
    thread_ = std::thread([this] { run(); });
    return ONI_STATUS_OK;
  }
  void stop() override { halt(); }

 private:
  void halt() {
    running_ = false;
    if (thread_.joinable()) thread_.join();
  }
  void run() {
    const ServedRecording& r = device_.recording;
    const std::uint64_t lap_us = r.frames.back().time_us + 33333;
    const Clock::time_point start = Clock::now();
    for (int n = 0; running_ && device_.plugged; ++n) {
      const std::size_t lap = static_cast<std::size_t>(n) / r.frames.size();
      const ServedRecording::Frame& frame = r.frames[static_cast<std::size_t>(n) % r.frames.size()];
      const std::uint64_t time_us = frame.time_us + lap * lap_us;
      std::this_thread::sleep_until(start + std::chrono::microseconds(time_us));
      if (!running_) return;
      const Faults& faults = device_.faults;
      if (faults.stall_after > 0 && n == faults.stall_after && !device_.stalled_once.exchange(true)) {
        std::this_thread::sleep_for(std::chrono::milliseconds(faults.stall_ms));
      }
      if (faults.unplug_after > 0 && n == faults.unplug_after) {
        device_.asks_unplug = true;
        return;
      }
      const bool dropped = faults.drop_every > 0 && n % faults.drop_every == faults.drop_every - 1;
      if (!dropped) send(frame, n, time_us);
    }
  }
  void send(const ServedRecording::Frame& source, int number, std::uint64_t time_us) {
    OniFrame* frame = getServices().acquireFrame();
    if (frame == nullptr) return;
    frame->frameIndex = number + 1;
    frame->timestamp = time_us + 5000000;  // device clocks start anywhere
    frame->videoMode = mode_;
    frame->width = mode_.resolutionX;
    frame->height = mode_.resolutionY;
    frame->sensorType = ONI_SENSOR_DEPTH;
    frame->croppingEnabled = FALSE;
    frame->cropOriginX = frame->cropOriginY = 0;
    frame->stride = mode_.resolutionX * 2;
    frame->dataSize = frame->stride * mode_.resolutionY;
    fill(source, static_cast<std::uint16_t*>(frame->data));
    raiseNewFrame(frame);
    getServices().releaseFrame(frame);
  }
  void fill(const ServedRecording::Frame& source, std::uint16_t* pixels) const {
    const int step = device_.recording.width / mode_.resolutionX;
    const int scale = mode_.pixelFormat == ONI_PIXEL_FORMAT_DEPTH_100_UM ? 10 : 1;
    for (int y = 0; y < mode_.resolutionY; ++y) {
      for (int x = 0; x < mode_.resolutionX; ++x) {
        const int from_x = mirrored_ ? mode_.resolutionX - 1 - x : x;
        const auto i = static_cast<std::size_t>(y * step) * static_cast<std::size_t>(device_.recording.width) +
                       static_cast<std::size_t>(from_x * step);
        *pixels++ = static_cast<std::uint16_t>(source.steps[i] * scale);
      }
    }
  }

  Device& device_;
  OniVideoMode mode_{};
  std::atomic<bool> mirrored_{true};
  std::atomic<bool> running_{false};
  std::thread thread_;
};

class OpenDevice : public oni::driver::DeviceBase {
 public:
  explicit OpenDevice(Device& device) : device_(device), modes_(Stream(device).modes()) {
    sensor_ = {ONI_SENSOR_DEPTH, static_cast<int>(modes_.size()), modes_.data()};
  }
  OniStatus getSensorInfoList(OniSensorInfo** sensors, int* count) override {
    *sensors = &sensor_;
    *count = 1;
    return ONI_STATUS_OK;
  }
  oni::driver::StreamBase* createStream(OniSensorType type) override {
    return type == ONI_SENSOR_DEPTH ? new Stream(device_) : nullptr;
  }
  void destroyStream(oni::driver::StreamBase* stream) override { delete stream; }

 private:
  Device& device_;
  std::array<OniVideoMode, 4> modes_;
  OniSensorInfo sensor_{};
};

}  // namespace

class Driver : public oni::driver::DriverBase {
 public:
  explicit Driver(OniDriverServices* services) : DriverBase(services) {
    std::strcpy(info_.uri, "depthmocap-test/1@1");
    std::strcpy(info_.vendor, "depthmocap");
    std::strcpy(info_.name, "Served recording");
  }
  ~Driver() override { shutdown(); }

  OniStatus initialize(oni::driver::DeviceConnectedCallback connected,
                       oni::driver::DeviceDisconnectedCallback disconnected,
                       oni::driver::DeviceStateChangedCallback changed, void* cookie) override {
    const OniStatus status = DriverBase::initialize(connected, disconnected, changed, cookie);
    device_.recording = readServedRecording(fromEnvironment("DEPTHMOCAP_TEST_RECORDING"));
    if (status != ONI_STATUS_OK || device_.recording.frames.empty()) return status;
    deviceConnected(&info_);
    running_ = true;
    cable_ = std::thread([this] { moveCable(); });
    return ONI_STATUS_OK;
  }
  oni::driver::DeviceBase* deviceOpen(const char*, const char*) override {
    return device_.plugged ? new OpenDevice(device_) : nullptr;
  }
  void deviceClose(oni::driver::DeviceBase* device) override { delete device; }
  void shutdown() override {
    running_ = false;
    if (cable_.joinable()) cable_.join();
  }

 private:
  // Like a USB stack, tells of the cable on a thread of its own.
  void moveCable() {
    while (running_) {
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
      if (!device_.asks_unplug.exchange(false)) continue;
      device_.plugged = false;
      deviceDisconnected(&info_);
      const Clock::time_point back = Clock::now() + std::chrono::milliseconds(device_.faults.unplug_ms);
      while (running_ && Clock::now() < back) std::this_thread::sleep_for(std::chrono::milliseconds(2));
      device_.plugged = true;
      if (running_) deviceConnected(&info_);
    }
  }

  OniDeviceInfo info_{};
  Device device_;
  std::atomic<bool> running_{false};
  std::thread cable_;
};

}  // namespace depthmocap::testdriver

// The runtime looks for these names in every library of its drivers folder.
#define XN_NEW(Type, ...) new Type(__VA_ARGS__)
#define XN_DELETE(pointer) delete pointer
using TestDriver = depthmocap::testdriver::Driver;
ONI_EXPORT_DRIVER(TestDriver)
