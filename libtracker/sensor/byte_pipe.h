#pragma once
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "libtracker/sensor/depth_source.h"

namespace depthmocap {

// Bytes that another program sends: standard input, a FIFO, a file, or a Unix socket that it listens on.
class BytePipe {
 public:
  enum class Take {
    Whole,    // all bytes came
    Waiting,  // not all yet; the next call goes on
    Ended,    // no more will come
    Failed,   // problem() says why
  };

  // "-" is standard input; else a path. Throws Error where it cannot be opened. A FIFO is waited for in take().
  explicit BytePipe(const std::string& address);
  ~BytePipe();
  BytePipe(const BytePipe&) = delete;
  BytePipe& operator=(const BytePipe&) = delete;

  // Fills `to` by the time of `deadline`, or keeps what has come for the next call, which is for the same place. After
  // Whole the next piece begins.
  Take take(std::span<std::uint8_t> to, SensorClock::time_point deadline);
  // Bytes of the piece that is being taken.
  [[nodiscard]] std::size_t taken() const { return taken_; }
  [[nodiscard]] const std::string& problem() const { return problem_; }

 private:
  int file_ = -1;
  bool ours_ = true;  // to close
  std::size_t taken_ = 0;
  std::string problem_;
};

}  // namespace depthmocap
