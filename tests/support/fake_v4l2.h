#pragma once
#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include <linux/videodev2.h>
#include <poll.h>

#include "libtracker/sensor/v4l2_system.h"

namespace depthmocap {

// A kernel with one V4L2 camera: speaks the ioctls as the kernel's documentation has them, and keeps to the order that
// it demands (format before memory, memory before streaming; a picture only in a buffer that was given to it).
class FakeV4l2 : public V4l2System {
 public:
  struct Picture {
    std::vector<std::uint8_t> bytes;
    std::uint32_t sequence = 0;
    double time_s = 0;
    std::uint32_t flags = V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC;
  };

  // What the camera is; may be changed before it is opened.
  std::vector<std::uint32_t> formats = {V4L2_PIX_FMT_YUYV, V4L2_PIX_FMT_Z16};
  std::vector<std::pair<std::uint32_t, std::uint32_t>> sizes;  // none: the driver lists none
  std::uint32_t width = 8;                                     // set now; sizes change it
  std::uint32_t height = 6;
  std::uint32_t padding = 0;  // bytes after each line
  std::uint32_t capabilities = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
  int open_error = 0;
  std::optional<std::uint32_t> sets_format;    // a lie: whatever it is asked for
  std::optional<std::uint32_t> buffer_length;  // a lie: shorter than a picture
  std::uint32_t fps = 30;                      // 0: the driver does not speak of rates
  // What it sends, one picture for each wait; then nothing, or it is unplugged.
  std::deque<Picture> pictures;
  bool unplugged_at_end = false;
  bool wakes_without_picture = false;  // poll says there is one, and there is none

  // What must be even at the end.
  int open_devices = 0;
  int mapped = 0;
  std::string misuse;  // what the kernel would not have accepted

  int open(const char* path) override {
    if (open_error != 0) return -open_error;
    if (std::strcmp(path, "/dev/video7") != 0) return -ENOENT;
    ++open_devices;
    return 42;
  }
  void close(int) override {
    --open_devices;
    buffers_.clear();
    queued_.clear();
    streaming_ = false;
  }

  int control(int device, unsigned long request, void* argument) override {
    if (device != 42) return -EBADF;
    if (unplugged_) return -ENODEV;
    switch (request) {
      case VIDIOC_QUERYCAP:
        return capability(*static_cast<v4l2_capability*>(argument));
      case VIDIOC_ENUM_FMT:
        return enumerate(*static_cast<v4l2_fmtdesc*>(argument));
      case VIDIOC_ENUM_FRAMESIZES:
        return enumerate(*static_cast<v4l2_frmsizeenum*>(argument));
      case VIDIOC_G_FMT:
        return fillFormat(*static_cast<v4l2_format*>(argument));
      case VIDIOC_S_FMT:
        return setFormat(*static_cast<v4l2_format*>(argument));
      case VIDIOC_S_PARM:
      case VIDIOC_G_PARM:
        return rate(*static_cast<v4l2_streamparm*>(argument));
      case VIDIOC_REQBUFS:
        return requestBuffers(*static_cast<v4l2_requestbuffers*>(argument));
      case VIDIOC_QUERYBUF:
        return queryBuffer(*static_cast<v4l2_buffer*>(argument));
      case VIDIOC_QBUF:
        return queue(*static_cast<v4l2_buffer*>(argument));
      case VIDIOC_DQBUF:
        return dequeue(*static_cast<v4l2_buffer*>(argument));
      case VIDIOC_STREAMON:
        streaming_ = true;
        return buffers_.empty() ? wrong("streaming without memory") : 0;
      case VIDIOC_STREAMOFF:
        streaming_ = false;
        return 0;
      default:
        return -ENOTTY;
    }
  }
  int waitForFrame(int, int) override {
    if (!streaming_) return POLLERR;
    if (wakes_without_picture) return POLLIN;
    if (!pictures.empty()) return queued_.empty() ? 0 : POLLIN;
    if (unplugged_at_end) unplugged_ = true;
    return unplugged_ ? POLLERR | POLLHUP : 0;
  }
  void* map(int, std::size_t, long offset) override {
    ++mapped;
    return buffers_[static_cast<std::size_t>(offset / kPage)].data();
  }
  void unmap(void*, std::size_t) override { --mapped; }

 private:
  static constexpr long kPage = 4096;

  int wrong(const std::string& what) {
    misuse = what;
    return -EINVAL;
  }
  [[nodiscard]] int capability(v4l2_capability& c) const {
    std::strcpy(reinterpret_cast<char*>(c.card), "Fake depth camera");
    c.capabilities = capabilities | V4L2_CAP_DEVICE_CAPS;
    c.device_caps = capabilities;
    return 0;
  }
  int enumerate(v4l2_fmtdesc& f) const {
    if (f.type != V4L2_BUF_TYPE_VIDEO_CAPTURE || f.index >= formats.size()) return -EINVAL;
    f.pixelformat = formats[f.index];
    return 0;
  }
  int enumerate(v4l2_frmsizeenum& s) const {
    if (s.index >= sizes.size()) return sizes.empty() ? -ENOTTY : -EINVAL;
    s.type = V4L2_FRMSIZE_TYPE_DISCRETE;
    s.discrete = {sizes[s.index].first, sizes[s.index].second};
    return 0;
  }
  int fillFormat(v4l2_format& f) const {
    v4l2_pix_format& pix = f.fmt.pix;
    pix.width = width;
    pix.height = height;
    pix.bytesperline = bytesPerLine(pix.pixelformat);
    pix.sizeimage = pictureBytes(pix.pixelformat);
    return 0;
  }
  int setFormat(v4l2_format& f) {
    if (!buffers_.empty()) return wrong("a format after memory was asked for");
    v4l2_pix_format& pix = f.fmt.pix;
    if (sets_format) pix.pixelformat = *sets_format;
    for (const auto& [w, h] : sizes) {
      if (w == pix.width && h == pix.height) {
        width = w;
        height = h;
      }
    }
    fourcc_ = pix.pixelformat;
    return fillFormat(f);
  }
  [[nodiscard]] std::uint32_t pictureBytes(std::uint32_t fourcc) const {
    return fourcc == V4L2_PIX_FMT_Y10BPACK ? (width * height * 10 + 7) / 8 : bytesPerLine(fourcc) * height;
  }
  // As gspca and uvcvideo have it: bits a pixel times width.
  [[nodiscard]] std::uint32_t bytesPerLine(std::uint32_t fourcc) const {
    if (fourcc == V4L2_PIX_FMT_Y10BPACK) return width * 10 / 8;
    return fourcc == V4L2_PIX_FMT_INZI ? 4 * width : 2 * width + padding;
  }
  int rate(v4l2_streamparm& p) const {
    if (fps == 0) return -ENOTTY;
    p.parm.capture.timeperframe = {1, fps};
    return 0;
  }
  int requestBuffers(v4l2_requestbuffers& r) {
    if (r.memory != V4L2_MEMORY_MMAP) return -EINVAL;
    buffers_.assign(r.count, std::vector<std::uint8_t>(buffer_length.value_or(pictureBytes(fourcc_))));
    return 0;
  }
  int queryBuffer(v4l2_buffer& b) {
    if (b.index >= buffers_.size()) return -EINVAL;
    b.length = static_cast<std::uint32_t>(buffers_[b.index].size());
    b.m.offset = static_cast<std::uint32_t>(b.index * kPage);
    return 0;
  }
  int queue(const v4l2_buffer& b) {
    if (b.index >= buffers_.size()) return -EINVAL;
    if (std::find(queued_.begin(), queued_.end(), b.index) != queued_.end()) return wrong("a buffer given twice");
    queued_.push_back(b.index);
    return 0;
  }
  int dequeue(v4l2_buffer& b) {
    if (!streaming_) return wrong("a picture asked for before streaming");
    if (pictures.empty() || queued_.empty()) return -EAGAIN;
    const Picture picture = pictures.front();
    pictures.pop_front();
    b.index = queued_.front();
    queued_.pop_front();
    std::vector<std::uint8_t>& memory = buffers_[b.index];
    std::copy_n(picture.bytes.begin(), std::min(picture.bytes.size(), memory.size()), memory.begin());
    b.bytesused = static_cast<std::uint32_t>(picture.bytes.size());
    b.flags = picture.flags;
    b.sequence = picture.sequence;
    b.timestamp.tv_sec = static_cast<long>(picture.time_s);
    b.timestamp.tv_usec = static_cast<long>((picture.time_s - static_cast<double>(b.timestamp.tv_sec)) * 1e6);
    return 0;
  }

  std::uint32_t fourcc_ = 0;
  std::vector<std::vector<std::uint8_t>> buffers_;
  std::deque<std::uint32_t> queued_;
  bool streaming_ = false;
  bool unplugged_ = false;
};

}  // namespace depthmocap
