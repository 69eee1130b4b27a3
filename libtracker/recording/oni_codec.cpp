#include "libtracker/recording/oni_codec.h"

#include <cstring>

namespace depthmocap {

namespace {

// How differences are packed. A byte below 0xE0 holds two numbers of 4 bits, each the value before minus the value,
// plus 6, or one of two signs.
constexpr int kZeroNibble = 6;
constexpr int kPadding = 0xD;    // no value: the picture had an odd number
constexpr int kEscape = 0xF;     // the value follows in full
constexpr int kFirstRun = 0xE0;  // 0xE0 + n: 2 n times the value before
constexpr int kEscapeByte = 0xFF;
constexpr int kLongDifference =
    0x80;                       // after an escape: the difference plus 192 in one byte, or else 16 bits of value,
constexpr int kZeroLong = 192;  // the high byte first

class DifferenceReader {
 public:
  DifferenceReader(std::string_view bytes, std::vector<std::uint16_t>& values) : bytes_(bytes), values_(values) {}

  // True if the bytes give just as many values as there is room for.
  bool read() {
    if (bytes_.size() < 2 || values_.empty()) return false;
    last_ = byte(0) | byte(1) << 8;
    position_ = 2;
    bool good = put();
    while (good && position_ < bytes_.size()) good = step();
    return good && count_ == values_.size();
  }

 private:
  [[nodiscard]] int byte(std::size_t i) const { return static_cast<unsigned char>(bytes_[i]); }

  bool step() {
    const int code = byte(position_++);
    if (code == kEscapeByte) return full();
    if (code >= kFirstRun + 0x10) return false;
    if (code >= kFirstRun) {
      for (int i = 0; i < 2 * (code - kFirstRun); ++i) {
        if (!put()) return false;
      }
      return true;
    }
    return nibble(code >> 4) && nibble(code & 0xF);
  }
  bool nibble(int code) {
    if (code == kPadding) return true;
    if (code == kEscape) return full();
    last_ -= code - kZeroNibble;
    return put();
  }
  bool full() {
    if (position_ >= bytes_.size()) return false;
    const int high = byte(position_++);
    if (high >= kLongDifference) {
      last_ -= high - kZeroLong;
    } else {
      if (position_ >= bytes_.size()) return false;
      last_ = high << 8 | byte(position_++);
    }
    return put();
  }
  bool put() {
    if (count_ == values_.size()) return false;
    last_ &= 0xFFFF;
    values_[count_++] = static_cast<std::uint16_t>(last_);
    return true;
  }

  std::string_view bytes_;
  std::vector<std::uint16_t>& values_;
  std::size_t position_ = 0;
  std::size_t count_ = 0;
  int last_ = 0;
};

std::uint16_t value16(std::string_view bytes, std::size_t offset) {
  std::uint16_t value = 0;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

bool unpackWithTable(std::string_view bytes, std::vector<std::uint16_t>& pixels) {
  if (bytes.size() < 2) return false;
  const std::size_t entries = value16(bytes, 0);
  const std::size_t start = 2 + 2 * entries;
  if (bytes.size() < start || !DifferenceReader(bytes.substr(start), pixels).read()) return false;
  for (std::uint16_t& pixel : pixels) {
    if (pixel >= entries) return false;
    pixel = value16(bytes, 2 + 2 * static_cast<std::size_t>(pixel));
  }
  return true;
}

}  // namespace

bool unpackOniPicture(const std::array<char, 4>& codec, std::string_view bytes, std::vector<std::uint16_t>& pixels) {
  const std::string_view name(codec.data(), codec.size());
  if (name == "16zT") return unpackWithTable(bytes, pixels);
  if (name == "16zP") return DifferenceReader(bytes, pixels).read();
  if (name != "NONE" || bytes.size() != 2 * pixels.size()) return false;
  std::memcpy(pixels.data(), bytes.data(), bytes.size());
  return true;
}

}  // namespace depthmocap
