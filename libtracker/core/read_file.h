#pragma once
#include <cstddef>
#include <filesystem>
#include <string>

namespace depthmocap {

constexpr std::size_t mebibytes(std::size_t count) {
  return count << 20U;
}

// The whole content of a file of at most so many bytes, which is what bounds the memory: a device or a pipe that never
// ends is refused like a file that is too large, after 128 MiB. Throws Error naming the path and the reason; `what`
// names the kind of file in it ("the pose database").
std::string readFile(const std::filesystem::path& path, const std::string& what, std::size_t most_bytes);

}  // namespace depthmocap
