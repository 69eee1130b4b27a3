#include "libtracker/sensor/v4l2_system.h"

#include <cerrno>

#include <fcntl.h>
#include <linux/videodev2.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <unistd.h>

namespace depthmocap {

namespace {

template <typename Call>
int untilDone(const Call& call) {
  int result = -1;
  do {
    result = call();
  } while (result < 0 && errno == EINTR);
  return result < 0 ? -errno : result;
}

class RealSystem : public V4l2System {
 public:
  int open(const char* path) override {
    return untilDone([path] { return ::open(path, O_RDWR | O_NONBLOCK | O_CLOEXEC); });
  }
  int control(int device, unsigned long request, void* argument) override {
    return untilDone([=] { return ::ioctl(device, request, argument); });
  }
  int waitForFrame(int device, int timeout_ms) override {
    pollfd wait{device, POLLIN, 0};
    const int result = untilDone([&wait, timeout_ms] { return ::poll(&wait, 1, timeout_ms); });
    return result <= 0 ? result : wait.revents;
  }
  void* map(int device, std::size_t bytes, long offset) override {
    void* memory = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, device, offset);
    return memory == MAP_FAILED ? nullptr : memory;
  }
  void unmap(void* memory, std::size_t bytes) override { ::munmap(memory, bytes); }
  void close(int device) override { ::close(device); }
};

}  // namespace

V4l2System& realV4l2System() {
  static RealSystem system;
  return system;
}

std::vector<std::uint32_t> offeredFourccs(V4l2System& system, int device) {
  std::vector<std::uint32_t> offered;
  for (std::uint32_t i = 0; i < kMostListed; ++i) {
    v4l2_fmtdesc description{};
    description.index = i;
    description.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    if (system.control(device, VIDIOC_ENUM_FMT, &description) < 0) break;
    offered.push_back(description.pixelformat);
  }
  return offered;
}

}  // namespace depthmocap
