#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

#include <sys/mman.h>
#include <unistd.h>

#include "depthmocap/error.h"

// A fuzz target is a function of bytes that must end with a value or with an Error: whatever else is thrown, a bug's
// logic_error above all, ends the program, which is what the fuzzer looks for.
#define DEPTHMOCAP_FUZZ(function)                                                     \
  extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) { \
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);          \
    try {                                                                             \
      function(bytes);                                                                \
    } catch (const depthmocap::Error&) { /* refused */                                \
    }                                                                                 \
    return 0;                                                                         \
  }

namespace depthmocap {

// Bytes as a file that is in memory only.
class MemoryFile {
 public:
  explicit MemoryFile(std::string_view bytes) : file_(memfd_create("fuzz", MFD_CLOEXEC)) {
    if (file_ < 0 || ::write(file_, bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size())) {
      throw std::runtime_error("no file in memory");
    }
  }
  ~MemoryFile() { ::close(file_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  [[nodiscard]] std::filesystem::path path() const { return "/proc/self/fd/" + std::to_string(file_); }

 private:
  int file_;
};

// Runs each part and swallows its Error, so that a target may give one input to several parsers.
template <typename... Parts>
void each(Parts&&... parts) {
  const auto one = [](auto&& part) {
    try {
      part();
    } catch (const Error&) {  // NOLINT(bugprone-empty-catch): refused, as it should
    }
  };
  (one(parts), ...);
}

}  // namespace depthmocap
