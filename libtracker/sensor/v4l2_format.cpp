#include "libtracker/sensor/v4l2_format.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include <linux/videodev2.h>

#include "libtracker/core/check.h"

namespace depthmocap {

namespace {

static_assert(std::endian::native == std::endian::little, "pixels are copied as they lie in memory");

constexpr std::array<std::uint32_t, 4> kDepthFourccs = {V4L2_PIX_FMT_Z16, V4L2_PIX_FMT_INZI, V4L2_PIX_FMT_Y10BPACK,
                                                        V4L2_PIX_FMT_Y16};
constexpr int kNoDisparity10 = 1023;  // of the camera's 10 bits
constexpr int kNoDisparity = 2047;    // of 11 bits

std::size_t pixelsOf(const V4l2Format& format) {
  return static_cast<std::size_t>(format.width) * static_cast<std::size_t>(format.height);
}

// Of a row of one plane. INZI's rows have no gaps, and what drivers call a line of it is one of both planes.
std::size_t rowBytes(const V4l2Format& format) {
  return static_cast<std::size_t>(format.fourcc == V4L2_PIX_FMT_INZI ? 2 * format.width : format.bytes_per_line);
}

std::size_t planeBytes(const V4l2Format& format) {
  return rowBytes(format) * static_cast<std::size_t>(format.height);
}

void copyRows(const V4l2Format& format, const std::uint8_t* bytes, Image<std::uint16_t>& steps) {
  for (int y = 0; y < format.height; ++y) {
    std::memcpy(&steps.at(0, y), bytes + static_cast<std::size_t>(y) * rowBytes(format),
                2 * static_cast<std::size_t>(format.width));
  }
}

// The camera's 10 bits are the upper ones of its 11.
std::array<std::uint16_t, 1024> makeKinectTable() {
  std::array<std::uint16_t, 1024> table{};
  for (int value = 0; value < kNoDisparity10; ++value) {
    table[static_cast<std::size_t>(value)] = kinectMillimetres(2 * value);
  }
  return table;
}

// Ten bits a pixel, the high ones first, without gaps.
void unpackTenBits(std::span<const std::uint8_t> bytes, bool raw, Image<std::uint16_t>& steps) {
  static const std::array<std::uint16_t, 1024> kTable = makeKinectTable();
  std::size_t bit = 0;
  for (std::uint16_t& step : steps.data) {
    const std::size_t byte = bit / 8;
    const unsigned both = static_cast<unsigned>(bytes[byte]) << 8U | bytes[byte + 1];
    const unsigned value = both >> (6U - bit % 8) & 0x3FFU;
    const bool none = value == static_cast<unsigned>(kNoDisparity10);
    step = raw ? static_cast<std::uint16_t>(none ? 0 : value) : kTable[value];
    bit += 10;
  }
}

}  // namespace

std::span<const std::uint32_t> depthFourccs() {
  return kDepthFourccs;
}

std::string fourccName(std::uint32_t fourcc) {
  std::string name;
  for (unsigned shift = 0; shift < 32; shift += 8) {
    const char c = static_cast<char>(fourcc >> shift & 0x7FU);
    name += c >= ' ' && c < 0x7F ? c : '?';
  }
  while (!name.empty() && name.back() == ' ') name.pop_back();
  return name;
}

std::string fourccNames(std::span<const std::uint32_t> fourccs) {
  std::string names;
  for (const std::uint32_t fourcc : fourccs) names += (names.empty() ? "" : ", ") + fourccName(fourcc);
  return names;
}

std::uint32_t fourccNamed(const std::string& name) {
  std::array<std::uint32_t, 4> c = {' ', ' ', ' ', ' '};
  for (std::size_t i = 0; i < std::min<std::size_t>(name.size(), 4); ++i) c[i] = static_cast<unsigned char>(name[i]);
  return v4l2_fourcc(c[0], c[1], c[2], c[3]);
}

double defaultDepthUnit_m(std::uint32_t fourcc) {
  return fourcc == V4L2_PIX_FMT_INZI ? 0.000125 : 0.001;
}

std::size_t pictureBytes(const V4l2Format& format) {
  if (format.fourcc == V4L2_PIX_FMT_Y10BPACK) return (pixelsOf(format) * 10 + 7) / 8;
  return planeBytes(format) * (format.fourcc == V4L2_PIX_FMT_INZI ? 2 : 1);
}

void unpack(const V4l2Format& format, std::span<const std::uint8_t> bytes, bool raw, Image<std::uint16_t>& steps) {
  DMC_CHECK(bytes.size() >= pictureBytes(format));
  steps.reset(format.width, format.height, 0);
  if (format.fourcc == V4L2_PIX_FMT_Y10BPACK) {
    unpackTenBits(bytes, raw, steps);
  } else {
    copyRows(format, bytes.data() + (format.fourcc == V4L2_PIX_FMT_INZI ? planeBytes(format) : 0), steps);
  }
}

std::uint16_t kinectMillimetres(int disparity) {
  constexpr double kReference_cm = 120;
  constexpr double kEmitter_cm = 7.5;
  constexpr double kPixel_cm = 0.1042;
  if (disparity < 0 || disparity >= kNoDisparity) return 0;
  const double shift_cm = ((disparity - 800) / 4.0 - 0.375) * kPixel_cm;
  if (shift_cm >= kEmitter_cm) return 0;  // beyond infinity
  const double mm = 10.0 * (shift_cm * kReference_cm / (kEmitter_cm - shift_cm) + kReference_cm);
  return mm > 0 && mm < 10000 ? static_cast<std::uint16_t>(std::lround(mm)) : std::uint16_t{0};
}

}  // namespace depthmocap
