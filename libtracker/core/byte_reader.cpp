#include "libtracker/core/byte_reader.h"

#include <cstring>
#include <utility>

#include "depthmocap/error.h"
#include "libtracker/core/read_file.h"

namespace depthmocap {
namespace {

constexpr std::size_t kMostBytes = mebibytes(64);  // the largest of ours, learned poses, has 1 MB

}  // namespace

ByteReader::ByteReader(const std::filesystem::path& path, std::string what)
    : bytes_(readFile(path, what, kMostBytes)), what_(std::move(what)), where_(path.string()) {}

void ByteReader::require(std::size_t size) const {
  if (bytes_.size() - at_ < size) throw Error(what_ + " is cut short", where_);
}

void ByteReader::raw(void* to, std::size_t size) {
  require(size);
  if (size > 0) std::memcpy(to, bytes_.data() + at_, size);  // `to` of nothing may be null
  at_ += size;
}

std::uint32_t ByteReader::count(std::uint32_t most) {
  std::uint32_t value = 0;
  raw(&value, sizeof value);
  check(value <= most);
  return value;
}

void ByteReader::check(bool condition) const {
  if (!condition) throw Error(what_ + " is damaged", where_);
}

}  // namespace depthmocap
