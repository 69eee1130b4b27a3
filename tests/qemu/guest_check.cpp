// Runs inside the guest: reads real V4L2 devices of a real kernel with our code, and checks every picture.
//
// Usage: guest_check LOOPBACK RECORDING CAMERA.json VIVID
//   LOOPBACK: a v4l2loopback device; RECORDING is written to it and must come back picture by picture, in each format.
//   VIVID: the kernel's test camera; streams Y16, then is unplugged.
#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstring>
#include <iterator>
#include <string>
#include <thread>

#include <fcntl.h>
#include <linux/videodev2.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "libtracker/recording/recording_header.h"
#include "libtracker/sensor/capture.h"
#include "libtracker/sensor/recorder.h"
#include "libtracker/sensor/v4l2_format.h"
#include "libtracker/sensor/v4l2_source.h"
#include "tests/qemu/feeder.h"

namespace depthmocap {
namespace {

constexpr unsigned kTenBits = 0x3FF;

// What a camera of that format sends for these steps, by the kernel's documentation: INZI is a plane of infrared before
// one of depth; Y10B is ten bits a pixel without gaps, the most significant ones first.
std::vector<std::uint8_t> bytesOf(std::uint32_t fourcc, const Picture16& steps) {
  const auto* plane = reinterpret_cast<const std::uint8_t*>(steps.data.data());
  std::vector<std::uint8_t> bytes;
  if (fourcc != V4L2_PIX_FMT_Y10BPACK) {
    if (fourcc == V4L2_PIX_FMT_INZI) bytes.assign(2 * steps.data.size(), 0x03);
    bytes.insert(bytes.end(), plane, plane + 2 * steps.data.size());
    return bytes;
  }
  std::uint32_t waiting = 0;
  int bits = 0;
  for (const std::uint16_t step : steps.data) {
    waiting = waiting << 10U | (step & kTenBits);
    for (bits += 10; bits >= 8; bits -= 8) bytes.push_back(static_cast<std::uint8_t>(waiting >> (bits - 8)));
  }
  return bytes;
}

bool shows(const DepthFrame& frame, const Picture16& steps) {
  for (std::size_t p = 0; p < steps.data.size(); ++p) {
    if (frame.depth.data[p] != static_cast<float>(steps.data[p] * 0.001)) return false;
  }
  return true;
}

SensorFrame nextFrame(DepthSource& source) {
  SensorFrame frame;
  for (int i = 0; i < 100; ++i) {
    const SourceState state = source.next(frame, std::chrono::milliseconds(100));
    if (state == SourceState::Frame) return frame;
    require(state == SourceState::Waiting, "the loopback device failed: " + source.problem());
  }
  throw std::runtime_error("a picture did not come");
}

void checkFormat(const std::string& device, std::uint32_t fourcc, const SourceOptions& options,
                 std::vector<Picture16> pictures) {
  if (fourcc == V4L2_PIX_FMT_Y10BPACK) {
    for (Picture16& picture : pictures) {
      for (std::uint16_t& step : picture.data) step = static_cast<std::uint16_t>(std::min(step / 8U, kTenBits - 1));
    }
  }
  const Feeder feeder(device, options.camera->camera, fourcc);
  feeder.send(bytesOf(fourcc, pictures[0]));
  const auto source = openV4l2Camera(device, options);
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    if (i > 0) feeder.send(bytesOf(fourcc, pictures[i]));
    require(shows(nextFrame(*source).depth, pictures[i]), "picture " + std::to_string(i) + " came changed");
  }
  std::printf("loopback: %zu pictures %s unchanged\n", pictures.size(), source->info().note.c_str());
}

void checkFormats(const std::string& device, const std::string& recording, const std::string& camera_file) {
  SourceOptions options;
  options.camera = readRecordingHeader(camera_file);
  options.depth_unit_m = 0.001;  // also of Y10B: its steps as they are
  const auto pictures = readPictures(recording, options.camera->camera, 5);
  for (const std::uint32_t fourcc : depthFourccs()) checkFormat(device, fourcc, options, pictures);
}

void checkLoopback(const std::string& device, const std::string& recording, const std::string& camera_file) {
  SourceOptions options;
  options.camera = readRecordingHeader(camera_file);
  const auto pictures = readPictures(recording, options.camera->camera, 60);
  const Feeder feeder(device, options.camera->camera);
  feeder.send(pictures[0]);
  const auto source = openV4l2Camera(device, options);
  std::printf("loopback: %dx%d from %s\n", source->info().camera.width, source->info().camera.height,
              source->info().camera_name.c_str());
  std::atomic<int> arrived{0};
  Recorder recorder("/tmp/recorded", source->info(), true);
  Capture capture(
      *source,
      [&](SensorFrame& frame) {
        recorder.push(frame);
        ++arrived;
        return true;
      },
      [] {});
  sendOneByOne(feeder, pictures, arrived);
  capture.stop();
  recorder.finish(capture.status().missing);
  const auto recorded = openRecording("/tmp/recorded");
  DepthFrame frame;
  std::size_t expected = 0;
  for (std::size_t i = 0; i < recorded->frameCount(); ++i) {
    recorded->read(i, frame);
    const auto is = [&frame](const Picture16& picture) { return shows(frame, picture); };
    if (expected > 0 && is(pictures[expected - 1])) continue;  // the loopback gave it again
    const auto found = std::find_if(pictures.begin(), pictures.end(), is) - pictures.begin();
    require(expected < pictures.size() && is(pictures[expected]),
            "picture " + std::to_string(expected) + " did not come; in its place came " +
                (found < std::ssize(pictures) ? std::to_string(found) : std::string("one that was never sent")));
    ++expected;
  }
  require(expected == pictures.size(), "pictures at the end are missing");
  std::printf("loopback: %zu pictures recorded, each of %zu came unchanged and in order, %lld missing\n",
              recorded->frameCount(), expected, static_cast<long long>(capture.status().missing));
}

void pressDisconnect(const std::string& device) {
  const int control = open(device.c_str(), O_RDWR);
  require(control >= 0, "cannot open the test camera a second time");
  v4l2_queryctrl query{};
  query.id = V4L2_CTRL_FLAG_NEXT_CTRL;
  while (ioctl(control, VIDIOC_QUERYCTRL, &query) == 0) {
    if (std::strcmp(reinterpret_cast<const char*>(query.name), "Disconnect") == 0) {
      v4l2_control press{query.id, 1};
      ioctl(control, VIDIOC_S_CTRL, &press);
      close(control);
      return;
    }
    query.id |= V4L2_CTRL_FLAG_NEXT_CTRL;
  }
  throw std::runtime_error("the test camera has no button to disconnect it");
}

void checkTestCamera(const std::string& device) {
  SourceOptions options;
  options.pixel_format = "Y16";
  const auto source = openV4l2Camera(device, options);
  std::printf("test camera: %dx%d at %.1f per second\n", source->info().camera.width, source->info().camera.height,
              source->info().fps);
  SensorFrame frame;
  int frames = 0;
  double last_s = -1;
  for (int i = 0; i < 200 && frames < 20; ++i) {
    const SourceState state = source->next(frame, std::chrono::milliseconds(500));
    require(state == SourceState::Frame || state == SourceState::Waiting,
            "the test camera failed: " + source->problem());
    if (state == SourceState::Waiting) continue;
    require(frame.depth.time_s > last_s, "times do not grow");
    require(frame.taken <= SensorClock::now(), "a picture from the future");
    last_s = frame.depth.time_s;
    ++frames;
  }
  require(frames == 20, "the test camera sends nothing");
  pressDisconnect(device);
  SourceState state = SourceState::Waiting;
  for (int i = 0; i < 50 && state != SourceState::Lost; ++i)
    state = source->next(frame, std::chrono::milliseconds(200));
  require(state == SourceState::Lost, "it went unnoticed that the test camera was unplugged");
  std::printf("test camera: 20 pictures, numbered to %lld in %.2f s; then: %s\n",
              static_cast<long long>(frame.depth.frame), last_s, source->problem().c_str());
}

}  // namespace
}  // namespace depthmocap

int main(int argc, char** argv) {
  try {
    depthmocap::require(argc == 5, "usage: guest_check LOOPBACK RECORDING CAMERA.json VIVID");
    depthmocap::checkFormats(argv[1], argv[2], argv[3]);
    depthmocap::checkLoopback(argv[1], argv[2], argv[3]);
    depthmocap::checkTestCamera(argv[4]);
    std::puts("GUEST OK");
    return 0;
  } catch (const std::exception& error) {
    std::printf("GUEST FAILED: %s\n", error.what());
    return 1;
  }
}
