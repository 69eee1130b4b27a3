#pragma once
#include <atomic>
#include <chrono>
#include <cstdio>
#include <span>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <linux/videodev2.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "depthmocap/camera_model.h"
#include "libtracker/recording/png_file.h"

namespace depthmocap {

using Picture16 = Image<std::uint16_t>;

inline void require(bool condition, const std::string& what) {
  if (!condition) throw std::runtime_error(what);
}

// Another program with pictures, as a user would pipe it: by write() to a loopback device.
class Feeder {
 public:
  Feeder(const std::string& device, const CameraModel& camera, std::uint32_t fourcc = V4L2_PIX_FMT_Y16)
      : device_(open(device.c_str(), O_WRONLY)) {
    require(device_ >= 0, "cannot open the loopback device for writing");
    v4l2_format format{};
    format.type = V4L2_BUF_TYPE_VIDEO_OUTPUT;
    format.fmt.pix.width = static_cast<std::uint32_t>(camera.width);
    format.fmt.pix.height = static_cast<std::uint32_t>(camera.height);
    format.fmt.pix.pixelformat = fourcc;
    require(ioctl(device_, VIDIOC_S_FMT, &format) == 0 && format.fmt.pix.pixelformat == fourcc,
            "the loopback device does not take the pixel format");
  }
  ~Feeder() { close(device_); }
  Feeder(const Feeder&) = delete;
  Feeder& operator=(const Feeder&) = delete;
  void send(std::span<const std::uint8_t> bytes) const {
    require(write(device_, bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size()),
            "a picture was not taken");
  }
  void send(const Picture16& picture) const {
    send({reinterpret_cast<const std::uint8_t*>(picture.data.data()), 2 * picture.data.size()});
  }

 private:
  int device_;
};

// Sends each picture once the one before has been dealt with, as `done` counts, or after a minute: an emulated
// processor has a pace of its own.
inline void sendOneByOne(const Feeder& feeder, std::span<const Picture16> pictures, const std::atomic<int>& done) {
  constexpr std::chrono::milliseconds kStep(10);
  constexpr int kPatience = 6000;  // steps
  for (const Picture16& picture : pictures) {
    const int before = done;
    feeder.send(picture);
    for (int i = 0; i < kPatience && done == before; ++i) std::this_thread::sleep_for(kStep);
  }
}

inline std::vector<Picture16> readPictures(const std::string& recording, const CameraModel& camera, int count) {
  std::vector<Picture16> pictures(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    char name[32];
    std::snprintf(name, sizeof name, "/depth/%06d.png", i);
    readPng16(recording + name, camera.width, camera.height, pictures[static_cast<std::size_t>(i)]);
  }
  return pictures;
}

}  // namespace depthmocap
