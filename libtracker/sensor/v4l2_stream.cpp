#include "libtracker/sensor/v4l2_stream.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <utility>

#include <fmt/format.h>
#include <linux/videodev2.h>
#include <poll.h>

#include "depthmocap/error.h"

namespace depthmocap {

namespace {

constexpr std::uint32_t kBuffers = 4;
constexpr std::uint32_t kCapture = V4L2_BUF_TYPE_VIDEO_CAPTURE;
constexpr DepthMode kUsualMode{640, 480, 30};

const char* adviceFor(int error) {
  switch (error) {
    case ENOENT:
    case ENODEV:
    case ENXIO:
      return "check that the camera is plugged in; ls /dev/video* shows what there is";
    case EACCES:
    case EPERM:
      return "you may not read it: add yourself to the group 'video' and log in again";
    case EBUSY:
      return "another program uses it; close that first";
    default:
      return "";
  }
}

}  // namespace

V4l2Stream::V4l2Stream(V4l2System& system, std::string path, const SourceOptions& options)
    : system_(system), path_(std::move(path)) {
  open();
  try {
    checkCamera();
    const std::uint32_t fourcc = chooseFourcc(options.pixel_format);
    const DepthMode mode = chooseMode(fourcc, options.mode);
    agree(fourcc, mode, options.mode.has_value());
    agreeRate(mode.fps);
    mapBuffers();
    start();
  } catch (...) {
    close();
    throw;
  }
}

V4l2Stream::~V4l2Stream() {
  close();
}

void V4l2Stream::fail(const std::string& what, int error, const std::string& advice) const {
  throw Error(what + ": " + std::strerror(error), path_, advice.empty() ? adviceFor(error) : advice);
}

void V4l2Stream::require(int result, const std::string& what) const {
  if (result < 0) fail(what, -result);
}

void V4l2Stream::open() {
  device_ = system_.open(path_.c_str());
  require(device_, "cannot be opened");
}

void V4l2Stream::close() {
  if (device_ < 0) return;
  int type = kCapture;
  system_.control(device_, VIDIOC_STREAMOFF, &type);
  for (const Buffer& buffer : buffers_) system_.unmap(buffer.memory, buffer.bytes);
  buffers_.clear();
  system_.close(device_);
  device_ = -1;
}

void V4l2Stream::checkCamera() {
  v4l2_capability capability{};
  if (system_.control(device_, VIDIOC_QUERYCAP, &capability) < 0) throw Error("is no camera", path_);
  const bool own = (capability.capabilities & V4L2_CAP_DEVICE_CAPS) != 0;
  const std::uint32_t can = own ? capability.device_caps : capability.capabilities;
  if ((can & V4L2_CAP_VIDEO_CAPTURE) == 0 || (can & V4L2_CAP_STREAMING) == 0) {
    throw Error("does not stream pictures", path_, "one camera may have several /dev/video*; try the others");
  }
  const auto* card = reinterpret_cast<const char*>(capability.card);
  name_.assign(card, strnlen(card, sizeof capability.card));
}

std::uint32_t V4l2Stream::chooseFourcc(const std::string& wanted) {
  const std::vector<std::uint32_t> offered = offeredFourccs(system_, device_);
  const std::string names = fourccNames(offered);
  const auto has = [&offered](std::uint32_t fourcc) {
    return std::find(offered.begin(), offered.end(), fourcc) != offered.end();
  };
  if (!wanted.empty() && !has(fourccNamed(wanted))) {
    throw Error("has no pixel format " + wanted, path_, "it has " + names);
  }
  if (!wanted.empty()) return fourccNamed(wanted);
  for (const std::uint32_t fourcc : depthFourccs()) {
    if (has(fourcc)) return fourcc;
  }
  throw Error("gives no depth: none of its pixel formats is Z16, INZI, Y10B or Y16", path_,
              (names.empty() ? "it has none" : "it has " + names) +
                  "; a depth camera often has several /dev/video*, and gspca_kinect needs depth_mode=1");
}

// The size that is asked for, else of those that the driver lists the one nearest the usual; else what is set now.
DepthMode V4l2Stream::chooseMode(std::uint32_t fourcc, const std::optional<DepthMode>& wanted) {
  if (wanted) return *wanted;
  const auto distance = [](const DepthMode& m) {
    return std::abs(m.width * m.height - kUsualMode.width * kUsualMode.height);
  };
  std::optional<DepthMode> best;
  for (std::uint32_t i = 0; i < kMostListed; ++i) {
    v4l2_frmsizeenum size{};
    size.index = i;
    size.pixel_format = fourcc;
    if (system_.control(device_, VIDIOC_ENUM_FRAMESIZES, &size) < 0 || size.type != V4L2_FRMSIZE_TYPE_DISCRETE) break;
    const DepthMode mode{static_cast<int>(size.discrete.width), static_cast<int>(size.discrete.height), kUsualMode.fps};
    if (!best || distance(mode) < distance(*best)) best = mode;
  }
  if (best) return *best;
  v4l2_format now{};
  now.type = kCapture;
  if (system_.control(device_, VIDIOC_G_FMT, &now) < 0 || now.fmt.pix.width == 0) return kUsualMode;
  return {static_cast<int>(now.fmt.pix.width), static_cast<int>(now.fmt.pix.height), kUsualMode.fps};
}

// The driver may change what it is asked for; its answer counts. `strict`: it must not.
void V4l2Stream::agree(std::uint32_t fourcc, const DepthMode& mode, bool strict) {
  v4l2_format format{};
  format.type = kCapture;
  format.fmt.pix.width = static_cast<std::uint32_t>(mode.width);
  format.fmt.pix.height = static_cast<std::uint32_t>(mode.height);
  format.fmt.pix.pixelformat = fourcc;
  format.fmt.pix.field = V4L2_FIELD_NONE;
  require(system_.control(device_, VIDIOC_S_FMT, &format), "refuses the format " + fourccName(fourcc));
  const v4l2_pix_format& pix = format.fmt.pix;
  if (pix.pixelformat != fourcc) {
    throw Error("lists the pixel format " + fourccName(fourcc) + ", but sets " + fourccName(pix.pixelformat), path_);
  }
  format_ = {fourcc, static_cast<int>(pix.width), static_cast<int>(pix.height), static_cast<int>(pix.bytesperline)};
  if (format_.width < 1 || format_.height < 1 || format_.width > 16384 || format_.height > 16384) {
    throw Error(fmt::format("sets pictures of {}x{}", pix.width, pix.height), path_);
  }
  if (strict && (format_.width != mode.width || format_.height != mode.height)) {
    throw Error(fmt::format("has no mode {}x{}", mode.width, mode.height), path_,
                fmt::format("it would take {}x{}", format_.width, format_.height));
  }
  format_.bytes_per_line = std::max(format_.bytes_per_line, 2 * format_.width);
}

// Many drivers have one rate and do not speak of it.
void V4l2Stream::agreeRate(double fps) {
  v4l2_streamparm rate{};
  rate.type = kCapture;
  v4l2_fract& interval = rate.parm.capture.timeperframe;
  if (fps > 0) {
    interval = {1000, static_cast<std::uint32_t>(std::lround(1000 * fps))};
    system_.control(device_, VIDIOC_S_PARM, &rate);
  }
  if (system_.control(device_, VIDIOC_G_PARM, &rate) < 0) return;
  if (interval.numerator > 0 && interval.denominator > 0) fps_ = double{1} * interval.denominator / interval.numerator;
}

void V4l2Stream::mapBuffers() {
  v4l2_requestbuffers request{};
  request.count = kBuffers;
  request.type = kCapture;
  request.memory = V4L2_MEMORY_MMAP;
  require(system_.control(device_, VIDIOC_REQBUFS, &request), "gives no memory for pictures");
  if (request.count < 2) throw Error("gives no memory for two pictures", path_);
  for (std::uint32_t i = 0; i < request.count; ++i) {
    v4l2_buffer buffer{};
    buffer.index = i;
    buffer.type = kCapture;
    buffer.memory = V4L2_MEMORY_MMAP;
    require(system_.control(device_, VIDIOC_QUERYBUF, &buffer), "does not say where its pictures lie");
    void* memory = system_.map(device_, buffer.length, static_cast<long>(buffer.m.offset));
    if (memory == nullptr) fail("its memory cannot be mapped", ENOMEM);
    buffers_.push_back({static_cast<std::uint8_t*>(memory), buffer.length});
    if (buffer.length < pictureBytes(format_)) {
      throw Error(fmt::format("gives {} bytes for a picture, {} {}x{} needs {}", buffer.length,
                              fourccName(format_.fourcc), format_.width, format_.height, pictureBytes(format_)),
                  path_);
    }
  }
}

void V4l2Stream::start() {
  for (std::uint32_t i = 0; i < buffers_.size(); ++i) require(giveBack(i), "does not take its memory back");
  int type = kCapture;
  require(system_.control(device_, VIDIOC_STREAMON, &type), "does not start");
}

int V4l2Stream::giveBack(std::uint32_t index) {
  v4l2_buffer buffer{};
  buffer.index = index;
  buffer.type = kCapture;
  buffer.memory = V4L2_MEMORY_MMAP;
  return system_.control(device_, VIDIOC_QBUF, &buffer);
}

SourceState V4l2Stream::lose(int error) {
  problem_ = path_ + ": " + (error == ENODEV ? "the camera was unplugged" : std::strerror(error));
  return SourceState::Lost;
}

SourceState V4l2Stream::next(V4l2Picture& picture, std::chrono::milliseconds timeout) {
  if (held_ >= 0) {
    const int given = giveBack(static_cast<std::uint32_t>(std::exchange(held_, -1)));
    if (given < 0) return lose(-given);
  }
  const int events = system_.waitForFrame(device_, static_cast<int>(timeout.count()));
  if (events < 0) return lose(-events);
  if (events == 0) return SourceState::Waiting;
  if ((events & POLLIN) == 0) return lose(ENODEV);  // POLLERR, POLLHUP: it will never have a picture again
  v4l2_buffer buffer{};
  buffer.type = kCapture;
  buffer.memory = V4L2_MEMORY_MMAP;
  const int taken = system_.control(device_, VIDIOC_DQBUF, &buffer);
  if (taken == -EAGAIN) return SourceState::Waiting;
  if (taken < 0) return lose(-taken);
  if (buffer.index >= buffers_.size()) return lose(EPROTO);
  held_ = static_cast<int>(buffer.index);
  const Buffer& memory = buffers_[buffer.index];
  const std::size_t used = std::min<std::size_t>(buffer.bytesused, memory.bytes);
  if ((buffer.flags & V4L2_BUF_FLAG_ERROR) != 0 || used < pictureBytes(format_)) {
    problem_ =
        fmt::format("{}: picture {} is damaged: {} of {} bytes", path_, buffer.sequence, used, pictureBytes(format_));
    return SourceState::Damaged;
  }
  picture.bytes = {memory.memory, used};
  picture.sequence = buffer.sequence;
  picture.time_s = static_cast<double>(buffer.timestamp.tv_sec) + static_cast<double>(buffer.timestamp.tv_usec) * 1e-6;
  picture.monotonic = (buffer.flags & V4L2_BUF_FLAG_TIMESTAMP_MASK) == V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC;
  return SourceState::Frame;
}

}  // namespace depthmocap
