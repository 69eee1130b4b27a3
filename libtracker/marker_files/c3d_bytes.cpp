#include "libtracker/marker_files/c3d_bytes.h"

#include <bit>
#include <cstring>

#include <fmt/format.h>

#include "depthmocap/error.h"
#include "libtracker/core/read_file.h"

namespace depthmocap {

C3dBytes::C3dBytes(const std::filesystem::path& path)
    : bytes_(readFile(path, "the C3D file", kMaxBytes)), where_(path.string()) {}

void C3dBytes::fail(const std::string& what) const {
  throw Error(what, where_);
}

void C3dBytes::require(std::size_t at, std::size_t size) const {
  if (at > bytes_.size() || bytes_.size() - at < size) {
    fail(fmt::format("is no C3D file, or cut short: byte {} is missing", at + size));
  }
}

std::uint8_t C3dBytes::byte(std::size_t at) const {
  require(at, 1);
  return static_cast<std::uint8_t>(bytes_[at]);
}

std::uint16_t C3dBytes::word(std::size_t at) const {
  const unsigned first = byte(at);
  const unsigned second = byte(at + 1);
  return static_cast<std::uint16_t>(processor == Processor::Mips ? first << 8U | second : second << 8U | first);
}

double C3dBytes::number(std::size_t at) const {
  const std::uint32_t first = word(at);
  const std::uint32_t second = word(at + 2);
  if (processor == Processor::Intel) return std::bit_cast<float>(second << 16U | first);
  const auto value = std::bit_cast<float>(first << 16U | second);
  // A VAX number has the more significant word first and an exponent that is larger by 2.
  return processor == Processor::Dec ? 0.25 * value : value;
}

std::string C3dBytes::text(std::size_t at, std::size_t length) const {
  require(at, length);
  std::string text = bytes_.substr(at, length);
  text.erase(text.find_last_not_of(std::string(" \0", 2)) + 1);
  for (char& c : text) c = c < ' ' || c > '~' ? '?' : c;
  return text;
}

}  // namespace depthmocap
