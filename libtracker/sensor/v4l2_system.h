#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

namespace depthmocap {

// The system calls that a V4L2 camera needs. Tests put a fake in their place.
class V4l2System {
 public:
  virtual ~V4l2System() = default;
  // All return a negative errno where they fail; a call that a signal interrupts is made again.
  virtual int open(const char* path) = 0;                                      // a descriptor
  virtual int control(int device, unsigned long request, void* argument) = 0;  // ioctl; 0
  virtual int waitForFrame(int device, int timeout_ms) = 0;           // poll; its revents, 0 = none came in time
  virtual void* map(int device, std::size_t bytes, long offset) = 0;  // mmap; nullptr where it fails
  virtual void unmap(void* memory, std::size_t bytes) = 0;
  virtual void close(int device) = 0;
};

// The one of this computer.
V4l2System& realV4l2System();

// The most formats or sizes that a device is asked for; no driver has so many.
inline constexpr std::uint32_t kMostListed = 64;

// The fourccs of the pixel formats that an open device lists, in its order.
std::vector<std::uint32_t> offeredFourccs(V4l2System& system, int device);

}  // namespace depthmocap
