#pragma once
#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

#include <fcntl.h>
#include <linux/videodev2.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "libtracker/core/camera.h"
#include "libtracker/recording/png_file.h"

namespace depthmocap {

inline void require(bool condition, const std::string& what) {
  if (!condition) throw std::runtime_error(what);
}

// Another program with depth, as a user would pipe it: Y16 pictures by write() to a loopback device.
class Feeder {
 public:
  Feeder(const std::string& device, const CameraModel& camera) : device_(open(device.c_str(), O_WRONLY)) {
    require(device_ >= 0, "cannot open the loopback device for writing");
    v4l2_format format{};
    format.type = V4L2_BUF_TYPE_VIDEO_OUTPUT;
    format.fmt.pix.width = static_cast<std::uint32_t>(camera.width);
    format.fmt.pix.height = static_cast<std::uint32_t>(camera.height);
    format.fmt.pix.pixelformat = V4L2_PIX_FMT_Y16;
    format.fmt.pix.sizeimage = format.fmt.pix.width * format.fmt.pix.height * 2;
    require(ioctl(device_, VIDIOC_S_FMT, &format) == 0, "the loopback device does not take Y16");
  }
  ~Feeder() { close(device_); }
  Feeder(const Feeder&) = delete;
  Feeder& operator=(const Feeder&) = delete;
  void send(const Image<std::uint16_t>& picture) const {
    const std::size_t bytes = picture.data.size() * 2;
    require(write(device_, picture.data.data(), bytes) == static_cast<ssize_t>(bytes), "a picture was not taken");
  }

 private:
  int device_;
};

inline std::vector<Image<std::uint16_t>> readPictures(const std::string& recording, const CameraModel& camera,
                                                      int count) {
  std::vector<Image<std::uint16_t>> pictures(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    char name[32];
    std::snprintf(name, sizeof name, "/depth/%06d.png", i);
    readPng16(recording + name, camera.width, camera.height, pictures[static_cast<std::size_t>(i)]);
  }
  return pictures;
}

}  // namespace depthmocap
