#pragma once
#include <chrono>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "libtracker/sensor/open_source.h"
#include "libtracker/sensor/v4l2_format.h"
#include "libtracker/sensor/v4l2_system.h"

namespace depthmocap {

// A picture in the driver's memory, valid until the next call of the stream.
struct V4l2Picture {
  std::span<const std::uint8_t> bytes;
  std::uint32_t sequence = 0;  // the driver's count
  double time_s = 0;           // [s] the driver's clock
  bool monotonic = false;      // time_s is of this computer's monotonic clock
};

// A V4L2 camera that streams depth into mapped memory. Not thread-safe.
class V4l2Stream {
 public:
  // Opens the device, agrees on a format and starts. Error if it is not there or not ours to read, is no camera, offers
  // no depth, or does not give the mode or format that `options` ask for. `system` outlives the stream.
  V4l2Stream(V4l2System& system, std::string path, const SourceOptions& options);
  ~V4l2Stream();
  V4l2Stream(const V4l2Stream&) = delete;
  V4l2Stream& operator=(const V4l2Stream&) = delete;

  [[nodiscard]] const V4l2Format& format() const { return format_; }
  [[nodiscard]] double fps() const { return fps_; }                // [1/s]
  [[nodiscard]] const std::string& name() const { return name_; }  // of the device

  // The next picture. Damaged: one came that is cut short, or that the driver calls bad.
  SourceState next(V4l2Picture& picture, std::chrono::milliseconds timeout);
  [[nodiscard]] const std::string& problem() const { return problem_; }

 private:
  struct Buffer {
    std::uint8_t* memory = nullptr;
    std::size_t bytes = 0;
  };
  void open();
  void close();
  void checkCamera();
  std::uint32_t chooseFourcc(const std::string& wanted);
  DepthMode chooseMode(std::uint32_t fourcc, const std::optional<DepthMode>& wanted);
  void agree(std::uint32_t fourcc, const DepthMode& mode, bool strict);
  void agreeRate(double fps);
  void mapBuffers();
  void start();
  int giveBack(std::uint32_t index);
  SourceState lose(int error);
  [[noreturn]] void fail(const std::string& what, int error, const std::string& advice = {}) const;
  void require(int result, const std::string& what) const;

  V4l2System& system_;
  std::string path_;
  int device_ = -1;
  std::string name_;
  V4l2Format format_;
  double fps_ = 30;
  std::vector<Buffer> buffers_;
  int held_ = -1;  // the buffer that the last picture lies in
  std::string problem_;
};

}  // namespace depthmocap
